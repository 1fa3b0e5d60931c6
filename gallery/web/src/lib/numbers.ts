// Numbers in words, as base/words/numbers.cpp writes them into the pages.

const kNames: Record<string, number> = { nan: NaN, inf: Infinity, '-inf': -Infinity };

/** A number of a record. JSON has no NaN and no infinities, so records spell them. */
export type RecordNumber = number | string | null | undefined;

export function toNumber(value: RecordNumber): number {
  if (typeof value === 'number') return value;
  return typeof value === 'string' ? kNames[value] ?? NaN : NaN;
}

const minus = (text: string): string => text.replace(/-/g, '−');

function parts(value: number, digits: number, plainFrom: number): { mantissa: string; exponent: string } {
  const size = Math.abs(value);
  if (value === 0) return { mantissa: '0', exponent: '' };
  if (size >= plainFrom && size < 10 ** Math.max(6, digits)) {
    const text = value.toPrecision(digits);
    return { mantissa: text.includes('e') ? String(Number(text)) : trimmed(text), exponent: '' };
  }
  const [mantissa = '', exponent = ''] = value.toExponential(digits - 1).split('e');
  return { mantissa: trimmed(mantissa), exponent: exponent.replace('+', '') };
}

function unusual(value: number): string | undefined {
  return Number.isFinite(value) ? undefined : Number.isNaN(value) ? '–' : value > 0 ? 'infinite' : '−infinite';
}

/** "0.0123", "1234", "4.9 × 10⁻⁴"; "–" where it is not a number. */
export function numberText(value: number, digits = 3): string {
  const { mantissa, exponent } = parts(value, digits, 1e-4);
  return unusual(value) ?? minus(mantissa) + (exponent && ` × ${powerText(exponent)}`);
}

/** "10⁻³" */
export function powerText(exponent: number | string): string {
  return '10' + String(exponent).replace(/[-0-9]/g, (c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)]!));
}

/** "4.9e−4": for where there is little room. */
export function shortText(value: number, digits = 3): string {
  const { mantissa, exponent } = parts(value, digits, 1e-3);
  return unusual(value) ?? minus(mantissa + (exponent && 'e' + exponent));
}

function trimmed(text: string): string {
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

/** With two digits. */
export function percentText(share: number): string {
  return numberText(100 * share, 2) + (Number.isNaN(share) ? '' : ' %');
}

export const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));
