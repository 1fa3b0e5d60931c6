// The values along a line across the picture, as a chart.
import { Chart, rangeOf } from '../lib/chart';
import { h } from '../lib/dom';
import { lineAcross, sampled } from './line';
import type { Viewer } from './viewer';

export class LineBox {
  private readonly chart = new Chart('Values along the line', 300);
  private readonly caption = h('figcaption', {}, '');
  readonly element = h('figure', { class: 'line-box', hidden: true }, this.caption, this.chart.element);
  private shown = '';

  show(viewer: Viewer, a: number, b: number): void {
    const line = viewer.choice.line();
    this.element.hidden = !line || !viewer.isFloat;
    const key = `${viewer.choice.state.get('line')} ${a} ${b} ${viewer.pictures.all.size}`;
    if (!line || !viewer.isFloat || key === this.shown) return;
    this.shown = key;
    const points = lineAcross(line, viewer.camera.size.width, viewer.camera.size.height);
    const series = [...new Set([a, b])].filter((i) => viewer.pictures.all.has(i)).map((i) => ({
      name: viewer.choice.data.engines[i]!.shortTitle, style: 1 + i % 5, ...sampled(points, (x, y) => viewer.pictures.valueAt(i, x, y)),
    }));
    const xs = series[0]?.x ?? [];
    this.chart.update({
      x: { label: 'pixels along the line', from: 0, to: Math.max(1, xs[xs.length - 1] ?? 1) },
      y: { label: 'radiance (mean of R, G, B)', ...rangeOf(series.flatMap((s) => s.y), false) }, series,
    });
    this.caption.textContent =
      `From pixel (${line.x0}, ${line.y0}) to (${line.x1}, ${line.y1}): the mean of red, green and blue of the pixels on the line.`;
  }
}
