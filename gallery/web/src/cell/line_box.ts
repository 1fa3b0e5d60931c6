// The values along a line across the picture, as a chart.
import { Chart, rangeOf } from '../lib/chart';
import { h } from '../lib/dom';
import type { Camera } from './camera';
import type { Choice } from './choice';
import type { ViewerState } from './viewer_state';

/** Pixels under the line inside the picture, one pixel apart, and how far along the line they are. */
function pixelsUnder({ x0, y0, x1, y1 }: NonNullable<ReturnType<Choice['line']>>, { width, height }: Camera['size']): { x: number; y: number; along: number }[] {
  const length = Math.hypot(x1 - x0, y1 - y0), count = Math.min(1e5, Math.ceil(length));
  return Array.from({ length: count + 1 }, (_, i) => {
    const share = count === 0 ? 0 : i / count;
    return { x: Math.round(x0 + share * (x1 - x0)), y: Math.round(y0 + share * (y1 - y0)), along: share * length };
  }).filter(({ x, y }) => x >= 0 && y >= 0 && x < width && y < height);
}

export class LineBox {
  private readonly caption = h('figcaption', {}, '');
  private readonly chart = new Chart('Values along the line', 300, () => ({ name: 'line', caption: (this.caption.textContent ?? '').replace(/\.$/, '') }));
  readonly element = h('figure', { class: 'line-box', hidden: true }, this.caption, this.chart.element);
  private shown = '';

  show(viewer: ViewerState, a: number, b: number): void {
    const line = viewer.choice.line();
    this.element.hidden = !line || !viewer.isFloat;
    const key = `${viewer.choice.state.get('line')} ${a} ${b} ${viewer.pictures.all.size}`;
    if (!line || !viewer.isFloat || key === this.shown) return;
    this.shown = key;
    const points = pixelsUnder(line, viewer.camera.size);
    const mean = (value?: readonly number[]): number => (value ? (value[0]! + value[1]! + value[2]!) / 3 : NaN);
    const series = [...new Set([a, b])].filter((i) => viewer.pictures.all.has(i)).map((i) => ({
      name: viewer.choice.data.engines[i]!.shortTitle, style: 1 + i % 5,
      x: points.map((p) => p.along), y: points.map((p) => mean(viewer.pictures.valueAt(i, p.x, p.y))),
    }));
    this.chart.update({
      x: { label: 'pixels along the line', from: 0, to: Math.max(1, series[0]?.x.at(-1) ?? 1) },
      y: { label: 'radiance (mean of R, G, B)', ...rangeOf(series.flatMap((s) => s.y), false) }, series,
    });
    this.caption.textContent =
      `From pixel (${line.x0}, ${line.y0}) to (${line.x1}, ${line.y1}): the mean of red, green and blue of the pixels on the line.`;
  }
}
