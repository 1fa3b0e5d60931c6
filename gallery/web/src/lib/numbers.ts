// Numbers in words, as core/numbers.cpp writes them into the pages.

const kNames: Record<string, number> = { nan: NaN, inf: Infinity, '-inf': -Infinity };

/** A record's number: JSON has no names for what is not finite, so records have. */
export type RecordNumber = number | string | null | undefined;

export function toNumber(value: RecordNumber): number {
  if (typeof value === 'number') return value;
  return typeof value === 'string' ? kNames[value] ?? NaN : NaN;
}

const minus = (text: string): string => text.replace(/-/g, '−');

export function numberText(value: number, digits = 3): string {
  if (Number.isNaN(value)) return 'not a number';
  if (!Number.isFinite(value)) return value > 0 ? 'infinite' : '−infinite';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e-4 && size < 10 ** Math.max(6, digits)) {
    const text = value.toPrecision(digits);
    return minus(text.includes('e') ? String(Number(text)) : trimmed(text));
  }
  const [mantissa = '', exponent = ''] = value.toExponential(digits - 1).split('e');
  return minus(trimmed(mantissa) + 'e' + exponent.replace('+', ''));
}

function trimmed(text: string): string {
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

export function percentText(share: number): string { return numberText(100 * share) + ' %'; }

export function secondsText(seconds: number): string {
  if (seconds < 1e-3) return numberText(seconds * 1e6) + ' µs';
  if (seconds < 1) return numberText(seconds * 1e3) + ' ms';
  return numberText(seconds) + ' s';
}

export const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));
