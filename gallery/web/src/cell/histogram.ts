// How many pixels of the two pictures are how bright.
import { Chart } from '../lib/chart';
import { h } from '../lib/dom';
import { numberText } from '../lib/numbers';
import type { FloatPictures } from './float_pictures';
import type { ViewerState } from './viewer_state';

const kBinsOfStop = 2, kStops = 24;

/** Pixels in each half stop of the largest of red, green and blue, up to `top`. */
function countsOf(pictures: FloatPictures, engine: number, width: number, height: number, top: number): number[] {
  const counts = new Array<number>(kBinsOfStop * kStops).fill(0);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const value = pictures.valueAt(engine, x, y), most = value ? Math.max(...value) : NaN;
      if (!(most > 0)) continue;
      const bin = counts.length - 1 - Math.floor(kBinsOfStop * Math.log2(top / most));
      if (bin >= 0 && bin < counts.length) ++counts[bin]!;
    }
  return counts;
}

export class Histogram {
  private readonly caption = h('figcaption', {}, '');
  private readonly chart = new Chart('Pixels by brightness', 220, () => ({ name: 'histogram', caption: (this.caption.textContent ?? '').replace(/\.$/, '') }));
  private readonly box = h('details', { class: 'histogram' }, h('summary', {}, 'Histogram'), this.chart.element, this.caption);
  readonly element = h('figure', { hidden: true }, this.box);
  private shown = '';

  constructor(repaint: () => void) { this.box.addEventListener('toggle', repaint); }

  show(viewer: ViewerState, a: number, b: number): void {
    this.element.hidden = !viewer.isFloat;
    const loaded = [...new Set([a, b])].filter((i) => viewer.pictures.all.has(i)), key = loaded.join(' ');
    if (!this.box.open || !viewer.isFloat || key === this.shown || loaded.length === 0) return;
    this.shown = key;
    const { width, height } = viewer.camera.size;
    const top = Math.max(...loaded.map((i) => viewer.pictures.largestOf(i, i, 'value')));
    const edges = Array.from({ length: kBinsOfStop * kStops }, (_, i) => top * 2 ** ((i + 0.5) / kBinsOfStop - kStops));
    const series = loaded.map((i) => ({
      name: viewer.choice.data.engines[i]!.shortTitle, style: 1 + i % 5, x: edges,
      y: countsOf(viewer.pictures, i, width, height, top).map((count) => count || NaN),
    }));
    const most = Math.max(1, ...series.flatMap((s) => s.y.filter(Number.isFinite)));
    this.chart.update({
      x: { label: 'brightest of red, green and blue', from: edges[0]!, to: top, logarithmic: true },
      y: { label: 'pixels in half a stop', from: 0.5, to: most * 1.2, logarithmic: true }, series,
    });
    this.caption.textContent = `${numberText(kStops)} stops below the brightest value, ${numberText(top)}; black pixels are not counted.`;
  }
}
