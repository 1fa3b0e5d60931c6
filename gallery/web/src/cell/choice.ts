// The reader's choices on a cell's page: from the link, limited to what the page has.
import { clamp, toNumber } from '../lib/numbers';
import { HashState } from '../lib/state';
import type { CellPage } from '../records';
import type { Measure } from './painter';

interface Line { readonly x0: number; readonly y0: number; readonly x1: number; readonly y1: number }

export const kModes = [
  { value: 'slide', label: 'Divider', key: 'l' },
  { value: 'flip', label: 'Flip', key: 'f' },
  { value: 'side', label: 'Side by side', key: 's' },
  { value: 'diff', label: 'Difference', key: 'd' },
] as const;
export const kMeasures = [
  { value: 'absolute', label: '|a − b|' },
  { value: 'relative', label: '|a − b| / b' },
  { value: 'signed', label: 'a − b, signed' },
] as const;
export const kStops = { from: -10, to: 14 }, kMostGain = 12;

const kDefaults = {
  a: '', b: '', mode: 'slide', shown: 'a', ev: '', colour: '', gain: '0', measure: 'absolute',
  x: '', y: '', z: '', at: '', split: '50', line: '', scale: 'linear', region: '',
};
export type LinkState = HashState<keyof typeof kDefaults>;
export const linkState = (): LinkState => new HashState(kDefaults);

export class Choice {
  constructor(readonly data: CellPage, readonly state: LinkState) {}

  /** Indices of the engines that have a picture. */
  engines(): number[] {
    return this.data.engines.flatMap((e, i) => (e.picture ? [i] : []));
  }

  engine(which: 'a' | 'b'): number {
    const shown = this.engines();
    const named = this.data.engines.findIndex((e) => e.name === this.state.get(which) && e.picture);
    if (named >= 0) return named;
    // Ours, and another engine rather than our formula.
    const rest = shown.filter((i) => i !== shown[0]), now = rest.filter((i) => !this.data.engines[i]!.beforeOf);
    const others = now.length > 0 ? now : rest;
    // A report has the reference first, and the picture that is judged is seen from its side.
    if (this.data.isReport && others.length > 0) return which === 'a' ? others[0]! : shown[0]!;
    return (which === 'a' ? shown[0] : others.find((i) => this.data.engines[i]!.name !== 'analytic') ?? others[0]) ?? 0;
  }

  /** Each picture of an earlier run, and the same engine's of now. */
  oldAgainstNew(): { a: string; b: string }[] {
    return this.engines().flatMap((i) => { const { name, beforeOf } = this.data.engines[i]!; return beforeOf ? [{ a: name, b: beforeOf }] : []; });
  }

  mode(): (typeof kModes)[number]['value'] {
    return kModes.find((m) => m.value === this.state.get('mode'))?.value ?? 'slide';
  }

  measure(): Measure { return kMeasures.find((m) => m.value === this.state.get('measure'))?.value ?? 'absolute'; }

  /** The maps that any pair of this cell has. */
  mapChoices(): { value: string; label: string }[] {
    const titles = new Map(this.data.comparisons.flatMap((c) => c.maps.map((m) => [m.id, m.title] as const)));
    return [...titles].map(([value, label]) => ({ value, label }));
  }

  mapAsked(): { value: string; label: string } | undefined {
    const measure = this.state.get('measure');
    return kMeasures.some((m) => m.value === measure) ? undefined : this.mapChoices().find((m) => m.value === measure);
  }

  baseStops(): number {
    const stops = toNumber(this.data.exposureStops);
    return Number.isFinite(stops) ? stops : 0;
  }

  stops(): number {
    const base = this.baseStops();
    return this.state.get('ev') === '' ? base : clamp(this.state.number('ev'), base + kStops.from, base + kStops.to);
  }

  gain(): number { return clamp(this.state.number('gain'), -kMostGain, kMostGain); }

  comparison(a: number, b: number): CellPage['comparisons'][number] | undefined {
    const names = [this.data.engines[a]?.name, this.data.engines[b]?.name];
    return a === b ? undefined : this.data.comparisons.find((c) => names.includes(c.a) && names.includes(c.b) && c.a !== c.b);
  }

  /** A report draws in what its verdict is about. */
  showsRegion(): boolean {
    const asked = this.state.get('region');
    return asked === '' ? this.data.isReport : asked === 'on';
  }

  /** From pixel to pixel. */
  line(): Line | undefined {
    const ends = this.state.get('line').split(',').map(Number);
    if (ends.length !== 4 || !ends.every((v) => Number.isFinite(v) && Math.abs(v) < 1e6)) return undefined;
    return { x0: ends[0]!, y0: ends[1]!, x1: ends[2]!, y1: ends[3]! };
  }
}
