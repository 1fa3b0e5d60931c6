// The colours of a metric. With a limit they are anchored to it: from a hundredth of it to ten times as much, calm
// below it. Without one they reach over the values, and stay calm.
import { h } from '../lib/dom';
import { clamp } from '../lib/numbers';
import { metricText, timesOver, type Values } from './cells';

/** The limit's place on the bar: two decades below it, one above. */
const kLimitAt = 2 / 3;

export class Scale {
  readonly isLimited: boolean;
  private readonly from: number;
  private readonly to: number;
  private readonly isLogarithmic: boolean;
  private readonly isSigned: boolean;
  private readonly isEmpty: boolean;

  constructor(private readonly of: Values) {
    let low = Infinity, high = -Infinity, positive = Infinity, isSigned = false, limited = false;
    for (let i = 0; i < of.values.length; ++i) {
      const value = of.values[i]!, size = this.size(i);
      if (value < 0) isSigned = true;
      if (!Number.isNaN(of.limits[i])) limited = true;
      if (!Number.isFinite(size)) continue;
      low = Math.min(low, size);
      high = Math.max(high, size);
      if (size > 0) positive = Math.min(positive, size);
    }
    this.isLimited = limited;
    // Errors span decades; likenesses do not.
    this.isLogarithmic = !of.metric.moreIsBetter && high > 20 * positive;
    this.from = this.isLogarithmic ? positive : low;
    this.to = high;
    this.isSigned = isSigned;
    this.isEmpty = !(low <= high);
  }

  /** An error's value without its sign. */
  size(cell: number): number { return this.of.metric.moreIsBetter ? this.of.values[cell]! : Math.abs(this.of.values[cell]!); }

  isOver(cell: number): boolean { return timesOver(this.of.metric, this.of.values[cell]!, this.of.limits[cell]!) > 1; }

  /** From 0 to 1; NaN where there is no value. */
  place(cell: number): number {
    const size = this.size(cell), times = timesOver(this.of.metric, this.of.values[cell]!, this.of.limits[cell]!);
    if (Number.isNaN(size)) return NaN;
    if (!Number.isNaN(times)) return times <= 0 ? 0 : clamp(kLimitAt + Math.log10(times) / 3, 0, 1);
    if (!Number.isFinite(size)) return 1;
    return clamp(this.isLogarithmic ? (size > 0 ? Math.log(size / this.from) / Math.log(this.to / this.from) : 0)
      : (size - this.from) / (this.to - this.from || 1), 0, 1);
  }

  colour(cell: number): string { return this.colourAt(this.place(cell), this.isOver(cell)); }

  private colourAt(place: number, isOver: boolean): string {
    if (!isOver) return `rgb(84 124 176 / ${(0.1 + 0.4 * (this.isLimited ? Math.min(1, place / kLimitAt) : place)).toFixed(3)})`;
    const part = clamp((place - kLimitAt) / (1 - kLimitAt), 0, 1), mix = (p: number, q: number): number => Math.round(p + (q - p) * part);
    return `rgb(${mix(190, 140)} ${mix(70, 0)} ${mix(0, 40)})`;
  }

  paint(swatch: HTMLElement, cell: number): void {
    const end = `${(100 * Math.max(0.03, this.place(cell))).toFixed(1)}%`;
    swatch.style.background = `linear-gradient(to right, ${this.colour(cell)} ${end}, transparent ${end})`;
    swatch.classList.toggle('limited', !Number.isNaN(this.of.limits[cell]));
  }

  legend(): Node[] {
    if (this.isEmpty) return [];
    const { metric, limits } = this.of, ramp = h('span', { class: this.isLimited ? 'ramp limited' : 'ramp' });
    const stops = Array.from({ length: 13 }, (_, i) => `${this.colourAt(i / 12, this.isLimited && i / 12 > kLimitAt)} ${(100 * i / 12).toFixed(1)}%`);
    ramp.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
    const sign = this.isSigned ? 'Coloured without its sign. ' : '';
    if (!this.isLimited)
      return [h('span', {}, metricText(metric, this.from)), ramp, h('span', {}, metricText(metric, this.to)),
        h('span', {}, (this.isLogarithmic ? 'logarithmic. ' : '') + 'It has no limit here. ' + sign + metric.meaning)];
    const first = limits.find((limit) => !Number.isNaN(limit))!, isOne = limits.every((limit) => Number.isNaN(limit) || limit === first);
    return [h('span', {}, '0.01 ×'), ramp, h('span', {}, '10 ×'),
      h('span', {}, `The mark is the limit${isOne ? ', ' + metricText(metric, first) : ' of each cell'}. The values are from ${metricText(metric, this.from)} to ${metricText(metric, this.to)}. ${sign}${metric.meaning}`)];
  }
}
