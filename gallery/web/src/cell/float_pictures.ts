// The float pictures of a cell, loaded on demand, and their values and differences.
import { clamp, shortText } from '../lib/numbers';
import type { CellPage } from '../records';
import { loadFloatPicture, roundingAt, type FloatPicture } from './half_picture';
import type { Measure, Rectangle } from './painter';

export interface Worst { readonly value: number; readonly x: number; readonly y: number }

export class FloatPictures {
  /** By the engine's index in the data. */
  readonly all = new Map<number, FloatPicture>();
  private readonly asked = new Set<number>();
  private readonly largest = new Map<string, Worst>();

  /** Calls `come` when a picture is loaded, `missing` when it cannot be, with the reason if there is one of its own. */
  constructor(private readonly data: CellPage, private readonly come: () => void,
              private readonly missing: (engine: number, why?: string) => void) {}

  /** Loads a picture, unless that was asked for before. */
  async need(engine: number): Promise<void> {
    if (this.asked.has(engine)) return;
    this.asked.add(engine);
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
      // Ours was rounded and the difference was not, so a sum this small may be nothing but the rounding.
      const sum = stored + ours!.values[at + c]!;
      return Math.abs(sum) <= roundingAt(ours!, ours!.values[at + c]!) ? 0 : sum;
    };
    return [value(0), value(1), value(2)];
  }

  /** With as many digits as were stored for ours and for the difference from it. */
  valueText(engine: number, x: number, y: number, c: number, value: number): string {
    const picture = this.all.get(engine), ours = this.all.get(0);
    if (!picture || !ours || value === 0 || !Number.isFinite(value)) return shortText(value);
    const at = 3 * (y * picture.width + x) + c;
    const rounding = roundingAt(ours, ours.values[at]!) + (picture.fromOurs ? roundingAt(picture, picture.values[at]!) : 0);
    return shortText(value, clamp(1 + Math.floor(Math.log10(Math.abs(value) / rounding)), 1, 4));
  }

  /** A box with some room around what has 5 % of our picture's peak; undefined if that is most of the picture. */
  highlight(): Rectangle | undefined {
    const ours = this.all.get(0);
    if (!ours) return undefined;
    const { width, height } = ours, least = 0.05 * this.largestOf(0, 0, 'value');
    let left = width, top = height, right = -1, bottom = -1;
    for (let i = 0; i < width * height; ++i) {
      if (!(Math.max(ours.values[3 * i]!, ours.values[3 * i + 1]!, ours.values[3 * i + 2]!) >= least)) continue;
      const x = i % width, y = Math.floor(i / width);
      left = Math.min(left, x); right = Math.max(right, x);
      top = Math.min(top, y); bottom = Math.max(bottom, y);
    }
    const side = 1.6 * Math.max(right - left + 1, bottom - top + 1, 8);
    if (right < 0 || side >= 0.8 * Math.min(width, height)) return undefined;
    return { x: (left + right + 1 - side) / 2, y: (top + bottom + 1 - side) / 2, width: side, height: side };
  }

  differenceAt(a: number, b: number, x: number, y: number): [number, number, number] | undefined {
    const first = this.all.get(a), second = this.all.get(b);
    const va = this.valueAt(a, x, y), vb = this.valueAt(b, x, y);
    if (!first || !second || !va || !vb) return undefined;
    const at = 3 * (y * first.width + x);
    const difference = (c: number): number => this.subtract(first, second, at + c, va[c]!, vb[c]!);
    return [difference(0), difference(1), difference(2)];
  }

  /** first − second at a place in `values`. Two stored differences from ours keep digits that the values `va` and `vb` have lost. */
  private subtract(first: FloatPicture, second: FloatPicture, at: number, va: number, vb: number): number {
    const fromOurs = (p: FloatPicture): number => (p.fromOurs ? p.values[at]! : p === this.all.get(0) ? 0 : NaN);
    const exact = fromOurs(first) - fromOurs(second);
    return Number.isFinite(exact) ? exact : va - vb;
  }

  /** The largest difference of the two, or with 'value' the largest value of `a`. */
  largestOf(a: number, b: number, measure: Measure | 'value'): number {
    return this.worst(a, b, measure)?.value || 1;
  }

  /** The same with its pixel; undefined until the pictures are loaded. */
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
      if (measure !== 'value') size = Math.abs(this.subtract(first, second, i, va, vb));
      if (measure === 'relative' && size !== 0) size /= Math.max(Math.abs(vb), 1e-37);
      if (Number.isFinite(size) && size > largest) { largest = size; where = i; }
    }
    if (measure === 'relative') largest = Math.min(largest, 1);
    const pixel = Math.floor(where / 3);
    const found = { value: largest, x: pixel % first.width, y: Math.floor(pixel / first.width) };
    this.largest.set(key, found);
    return found;
  }
}
