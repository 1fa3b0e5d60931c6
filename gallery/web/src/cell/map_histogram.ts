// The values of a map as a pooled histogram: each weighs as much as it is large, as in NVIDIA's tool of FLIP.
import { Chart } from '../lib/chart';
import { h } from '../lib/dom';
import { clamp, numberText } from '../lib/numbers';
import type { LoadedMap } from './maps';
import type { ViewerState } from './viewer_state';

const kBins = 100;

export interface Pooled {
  readonly pixels: number;
  readonly least: number;
  readonly most: number;
  readonly mean: number;
  /** Below these lie a quarter, half and three quarters of the sum of all values. */
  readonly quartiles: readonly [number, number, number];
}

/** Calls `take` with each finite value and the pixels of the cell that have it. */
function forEachValue({ picture }: LoadedMap, size: { width: number; height: number }, take: (value: number, pixels: number) => void): void {
  const { width, height, block, values } = picture;
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const value = values[3 * (y * width + x)]!;
      if (Number.isFinite(value)) take(value, Math.min(block, size.width - x * block) * Math.min(block, size.height - y * block));
    }
}

export function pooled(map: LoadedMap, size: { width: number; height: number }): Pooled {
  const all: { value: number; pixels: number }[] = [];
  let pixels = 0, sum = 0;
  forEachValue(map, size, (value, count) => {
    pixels += count;
    sum += value * count;
    if (value !== 0 || all.length === 0) all.push({ value, pixels: count });  // zeros weigh nothing
  });
  all.sort((a, b) => a.value - b.value);
  let below = 0, next = 0;
  const quartiles: [number, number, number] = [0, 0, 0], isAllZero = sum === 0;
  for (const one of all) {
    below += one.value * one.pixels;
    while (next < 3 && !isAllZero && below >= (next + 1) / 4 * sum) quartiles[next++] = one.value;
  }
  const zeros = pixels - all.reduce((count, one) => count + one.pixels, 0);
  return { pixels, least: zeros > 0 ? 0 : all[0]?.value ?? 0, most: all.at(-1)?.value ?? 0, mean: pixels > 0 ? sum / pixels : 0, quartiles };
}

/** The sum of the values in each bin from 0 to `top`, per million pixels. What is larger is in the last one. */
function binned(map: LoadedMap, size: { width: number; height: number }, top: number, pixels: number): number[] {
  const sums = new Array<number>(kBins).fill(0);
  forEachValue(map, size, (value, count) => { sums[clamp(Math.floor(kBins * value / top), 0, kBins - 1)]! += value * count * 1e6 / pixels; });
  return sums;
}

export class MapHistogram {
  private readonly caption = h('figcaption', {});
  private readonly heading = h('h3', { id: 'map-histogram' });
  private readonly chart = new Chart('Values of the map', 260, () => ({ name: this.file, caption: `${this.heading.textContent ?? ''}. ${(this.caption.textContent ?? '').replace(/\.$/, '')}` }));
  readonly element = h('figure', { class: 'map-histogram', hidden: true, 'aria-labelledby': 'map-histogram' }, this.heading, this.chart.element, this.caption);
  private shown = '';
  private file = '';
  private readonly known = new Map<string, Pooled>();

  /** Nothing, without a map. */
  show(viewer: ViewerState, a: number, b: number): void {
    const map = viewer.mapOf(a, b);
    this.element.hidden = !map;
    const top = map ? viewer.white(a, b) : 0, key = map ? `${map.script} ${top}` : '';
    if (!map || key === this.shown) return;
    this.shown = key;
    const { size } = viewer.camera, known = this.known.get(map.script) ?? pooled(map, size), { pixels, least, most, mean, quartiles } = known;
    this.known.set(map.script, known);
    const y = pixels > 0 ? binned(map, size, top, pixels) : [], highest = Math.max(1e-30, ...y);
    this.file = `${map.id}-histogram`;
    this.heading.textContent = `Histogram of ${map.title}`;
    const [first, median, third] = quartiles, text = (value: number): string => numberText(value, 3);
    this.chart.update({
      x: { label: map.title, from: 0, to: top }, y: { label: 'sum of values, per megapixel', from: 0, to: 1.5 * highest }, bars: true,
      series: [{ name: 'values, each weighed by itself', style: 1, x: y.map((_, i) => (i + 0.5) / kBins * top), y }],
      marks: [{ at: least, name: 'min' }, { at: mean, name: 'mean' }, { at: first, name: '1st quartile' }, { at: median, name: 'weighted median' }, { at: third, name: '3rd quartile' }, { at: most, name: 'max' }]
        .filter(({ at }) => at <= top),
    });
    this.caption.textContent = `Mean ${text(mean)}, weighted median ${text(median)}, quartiles ${text(first)} and ${text(third)}, from ${text(least)} to ${text(most)}. `
      + 'Each value weighs as much as it is large, as in NVIDIA’s FLIP tool'
      + (most > top ? `; what is over ${text(top)} is in the last bar` : '')
      + (map.picture.block > 1 ? `; each ${map.picture.block} × ${map.picture.block} pixels count with their largest value` : '') + '.';
  }
}
