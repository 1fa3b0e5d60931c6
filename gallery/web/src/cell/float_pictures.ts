// The float pictures of a cell: loaded when they are asked for, and their values and differences.
import { clamp, shortText } from '../lib/numbers';
import type { CellPage } from '../records';
import { loadFloatPicture, roundingAt, type FloatPicture } from './half_picture';
import type { Measure } from './painter';

export interface Worst { readonly value: number; readonly x: number; readonly y: number }

export class FloatPictures {
  /** By the engine's place in the data. */
  readonly all = new Map<number, FloatPicture>();
  private readonly loading = new Map<number, Promise<void>>();
  private readonly largest = new Map<string, Worst>();

  /** `come`: a picture is there. `missing`: it cannot be had, and why if there is a reason of its own. */
  constructor(private readonly data: CellPage, private readonly come: () => void,
              private readonly missing: (engine: number, why?: string) => void) {}

  need(engine: number): Promise<void> {
    const known = this.loading.get(engine);
    if (known) return known;
    const promise = this.loadOne(engine);
    this.loading.set(engine, promise);
    return promise;
  }

  private async loadOne(engine: number): Promise<void> {
    const source = this.data.engines[engine]?.floatScript;
    if (!source) return this.missing(engine);
    try {
      this.all.set(engine, await loadFloatPicture(source));
      this.come();
    } catch (error) {
      this.missing(engine, error instanceof Error ? error.message : String(error));
    }
  }

  /** Red, green and blue; undefined where the picture is not there. */
  valueAt(engine: number, x: number, y: number): [number, number, number] | undefined {
    const picture = this.all.get(engine), ours = this.all.get(0);
    if (!picture || (picture.fromOurs && !ours) || x < 0 || y < 0 || x >= picture.width || y >= picture.height) return undefined;
    const at = 3 * (y * picture.width + x);
    const value = (c: number): number => {
      const stored = picture.values[at + c]!;
      if (!picture.fromOurs) return stored;
      // Ours was rounded, the difference from it was not: what is left may be nothing but that.
      const sum = stored + ours!.values[at + c]!;
      return Math.abs(sum) <= roundingAt(ours!, ours!.values[at + c]!) ? 0 : sum;
    };
    return [value(0), value(1), value(2)];
  }

  /** As many digits as it was stored with: that of ours and of the difference from it. */
  valueText(engine: number, x: number, y: number, c: number, value: number): string {
    const picture = this.all.get(engine), ours = this.all.get(0);
    if (!picture || !ours || value === 0 || !Number.isFinite(value)) return shortText(value);
    const at = 3 * (y * picture.width + x) + c;
    const rounding = roundingAt(ours, ours.values[at]!) + (picture.fromOurs ? roundingAt(picture, picture.values[at]!) : 0);
    return shortText(value, clamp(1 + Math.floor(Math.log10(Math.abs(value) / rounding)), 1, 4));
  }

  differenceAt(a: number, b: number, x: number, y: number): [number, number, number] | undefined {
    const first = this.all.get(a), second = this.all.get(b);
    const va = this.valueAt(a, x, y), vb = this.valueAt(b, x, y);
    if (!first || !second || !va || !vb) return undefined;
    const at = 3 * (y * first.width + x);
    const raw = (p: FloatPicture, engine: number, c: number): number =>
      p.fromOurs ? p.values[at + c]! : engine === 0 ? 0 : NaN;
    const exact = (c: number): number => {
      const d = raw(first, a, c) - raw(second, b, c);  // both from ours: keeps all digits
      return Number.isFinite(d) ? d : va[c]! - vb[c]!;
    };
    return [exact(0), exact(1), exact(2)];
  }

  /** The largest difference of the two, or the largest value of one. */
  largestOf(a: number, b: number, measure: Measure | 'value'): number {
    return this.worst(a, b, measure)?.value || 1;
  }

  /** And where it is; undefined until the pictures are there. */
  worst(a: number, b: number, measure: Measure | 'value'): Worst | undefined {
    const key = `${a} ${b} ${measure}`, known = this.largest.get(key);
    if (known) return known;
    const first = this.all.get(a), second = this.all.get(b), ours = this.all.get(0);
    if (!first || !second || !ours) return undefined;
    let largest = 0, where = 0;
    for (let i = 0; i < first.values.length; ++i) {
      const base = ours.values[i]!;
      const va = first.values[i]! + (first.fromOurs ? base : 0), vb = second.values[i]! + (second.fromOurs ? base : 0);
      let size = measure === 'value' ? va : 0;
      if (measure !== 'value') {
        const da = first.fromOurs ? first.values[i]! : first === ours ? 0 : NaN;
        const db = second.fromOurs ? second.values[i]! : second === ours ? 0 : NaN;
        const exact = da - db;
        size = Math.abs(Number.isFinite(exact) ? exact : va - vb);
        if (measure === 'relative') size = size === 0 ? 0 : size / Math.max(Math.abs(vb), 1e-37);
      }
      if (Number.isFinite(size) && size > largest) { largest = size; where = i; }
    }
    if (measure === 'relative') largest = Math.min(largest, 1);
    const pixel = Math.floor(where / 3);
    const found = { value: largest, x: pixel % first.width, y: Math.floor(pixel / first.width) };
    this.largest.set(key, found);
    return found;
  }
}
