// A line chart that shows the values under the pointer, or at the arrow keys.
import { h, svg } from './dom';
import { figureButton, type FigureSource } from './figure';
import { fileName } from './figure_text';
import { clamp, numberText, powerText } from './numbers';

interface ChartAxis {
  /** With its unit. */
  readonly label: string;
  readonly from: number;
  readonly to: number;
  readonly logarithmic?: boolean;
}

/** A marked range of the x axis. */
interface ChartBand { readonly title: string; readonly from: number; readonly to: number }

export interface Series {
  readonly name: string;
  readonly x: readonly number[];
  readonly y: readonly number[];
  /** 0 is broad and pale, under the others; 1 to 5 have their own colours and dashes. */
  readonly style: number;
}

interface ChartContent {
  readonly x: ChartAxis;
  readonly y: ChartAxis;
  readonly series: readonly Series[];
  readonly bands?: readonly ChartBand[];
  /** A value with a line of its own, such as 1 of a ratio. */
  readonly level?: number | undefined;
  /** Each point is a bar, from the middle to the next ones. */
  readonly bars?: boolean;
  /** Places on the x axis with a name each. */
  readonly marks?: readonly { readonly at: number; readonly name: string }[];
}

let charts = 0;
const kMostWidth = 900, kLeastWidth = 320, kLeft = 76, kRight = 24, kTop = 20, kBottom = 44;
const kDashes = ['', '', '7 4', '2 3', '10 3 2 3', '5 2'];

/** Round numbers from `from` to `to`, about `count` of them; decades on a logarithmic axis. */
function ticks(axis: ChartAxis, count: number): number[] {
  const result: number[] = [];
  if (axis.logarithmic) {
    const first = Math.ceil(Math.log10(axis.from) - 1e-9), last = Math.floor(Math.log10(axis.to) + 1e-9);
    const step = Math.max(1, Math.ceil((last - first) / count));
    for (let e = first; e <= last; e += step) result.push(10 ** e);
    return result;
  }
  const rough = (axis.to - axis.from) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((n) => n * power).find((s) => s >= rough) ?? rough;
  for (let i = Math.ceil(axis.from / step - 1e-9); i * step <= axis.to + 1e-9 * step; ++i) result.push(i * step);
  return result;
}

/** The attributes of a series' line. */
function lineLook(style: number, width: number): Record<string, string | number> {
  return { class: `series series-${style}`, 'stroke-width': style === 0 ? 6 : width, 'stroke-dasharray': kDashes[style] ?? '' };
}

/** The position of a value along an axis, from 0 to 1. */
function shareOf(value: number, { from, to, logarithmic }: ChartAxis): number {
  return logarithmic ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from);
}

export class Chart {
  readonly element: HTMLElement;
  private readonly drawing: SVGSVGElement;
  private readonly readout = h('output', { class: 'readout' });
  private readonly hidden = new Set<string>();
  private readonly legend = h('div', { class: 'legend-row' });
  private content: ChartContent | undefined;
  private at: number | undefined;
  private readonly rule = svg('g', { class: 'rule' });
  private readonly clip = `chart-${++charts}-inside`;
  private width = kMostWidth;  // what the page has for it, so that letters keep their size

  /** `about` tells what the chart shows now, for its figure: a part of the file's name, and the caption. */
  constructor(private readonly title: string, private readonly height: number,
              private readonly about: () => { readonly name?: string; readonly caption?: string } = () => ({})) {
    this.drawing = svg('svg', {
      class: 'chart interactive', viewBox: `0 0 ${kMostWidth} ${height}`, tabindex: 0, role: 'img', 'aria-label': title,
    });
    this.drawing.addEventListener('pointermove', (event) => {
      const box = this.drawing.getBoundingClientRect();
      this.show(this.toX((event.clientX - box.left) * this.width / box.width));
    });
    this.drawing.addEventListener('pointerleave', () => this.show(undefined));
    this.drawing.addEventListener('keydown', (event) => this.key(event));
    this.element = h('div', { class: 'chart-box' }, this.legend, this.drawing,
      h('div', { class: 'chart-foot' }, this.readout, figureButton(title, () => this.figure())));
    new ResizeObserver(() => this.fit()).observe(this.element);
  }

  update(content: ChartContent): void {
    this.content = content;
    this.drawLegend(content.series);
    this.draw();
  }

  private fit(): void {
    const width = Math.round(clamp(this.element.clientWidth, kLeastWidth, kMostWidth));
    if (width === this.width || this.element.clientWidth === 0) return;
    this.width = width;
    this.drawing.setAttribute('viewBox', `0 0 ${width} ${this.height}`);
    this.draw();
  }

  private figure(): FigureSource {
    const series = this.visible(), { name = '', caption = '' } = this.about(), x = this.content?.x.label ?? '';
    const page = document.querySelector('h1')?.textContent ?? '', y = this.content?.y.label ?? '';
    return {
      name: fileName(page, name || this.title), title: this.title,
      caption: `${this.title}: ${y}, over ${x}. ${caption || page}.`,
      csv: { what: `${series.length === 1 ? 'the curve' : `${series.length} curves`}`, rows: () => rowsOf(series, x) },
      content: { drawing: this.drawing, legend: series.map((s) => ({ name: s.name, line: lineLook(s.style, 2) })) },
    };
  }

  private drawLegend(series: readonly Series[]): void {
    this.legend.replaceChildren(...series.map((s) => {
      const box = h('input', { type: 'checkbox' });
      box.checked = !this.hidden.has(s.name);
      box.addEventListener('change', () => {
        if (box.checked) this.hidden.delete(s.name); else this.hidden.add(s.name);
        this.draw();
      });
      const sample = svg('svg', { class: 'chart sample', width: 28, height: 10, 'aria-hidden': 'true' },
        svg('line', { ...lineLook(s.style, 2), x1: 0, x2: 28, y1: 5, y2: 5 }));
      return h('label', {}, box, sample, s.name);
    }));
  }

  private toX(across: number): number | undefined {
    if (!this.content) return undefined;
    const { x } = this.content, share = clamp((across - kLeft) / (this.width - kLeft - kRight), 0, 1);
    return x.logarithmic ? x.from * (x.to / x.from) ** share : x.from + (x.to - x.from) * share;
  }

  private across(value: number): number {
    return kLeft + shareOf(value, this.content!.x) * (this.width - kLeft - kRight);
  }

  private down(value: number): number {
    const bottom = this.height - kBottom;
    return kTop + (1 - clamp(shareOf(value, this.content!.y), -100, 100)) * (bottom - kTop);
  }

  private visible(): Series[] { return this.content?.series.filter((s) => !this.hidden.has(s.name)) ?? []; }

  private draw(): void {
    if (!this.content) return;
    const { x, y, bands = [], level } = this.content;
    const bottom = this.height - kBottom, right = this.width - kRight;
    const parts: SVGElement[] = [];
    bands.forEach((band, i) => {
      const left = this.across(clamp(band.from, x.from, x.to)), end = this.across(clamp(band.to, x.from, x.to));
      if (end <= left) return;
      parts.push(svg('rect', { class: `band-${i % 2}`, x: left, y: kTop, width: end - left, height: bottom - kTop }),
        svg('text', { class: 'band-label', x: left + 4, y: kTop - 6 }, band.title));
    });
    for (const value of ticks(y, 6)) {
      const at = this.down(value);
      parts.push(svg('line', { class: 'grid-line', x1: kLeft, x2: right, y1: at, y2: at }),
        svg('text', { class: 'tick-label', x: kLeft - 8, y: at + 4, 'text-anchor': 'end' }, tickText(value, y)));
    }
    for (const value of ticks(x, Math.max(3, Math.floor(this.width / 100)))) {
      const at = this.across(value);
      parts.push(svg('line', { class: 'tick', x1: at, x2: at, y1: bottom, y2: bottom + 5 }),
        svg('text', { class: 'tick-label', x: at, y: bottom + 18, 'text-anchor': 'middle' }, tickText(value, x)));
    }
    if (level !== undefined && level >= y.from && level <= y.to) {
      const at = this.down(level);
      parts.push(svg('line', { class: 'axis', x1: kLeft, x2: right, y1: at, y2: at }));
    }
    parts.push(svg('line', { class: 'axis', x1: kLeft, x2: right, y1: bottom, y2: bottom }),
      svg('line', { class: 'axis', x1: kLeft, x2: kLeft, y1: kTop, y2: bottom }),
      svg('text', { class: 'axis-label', x: right, y: this.height - 6, 'text-anchor': 'end' }, x.label),
      svg('text', { class: 'axis-label', transform: `translate(14 ${(kTop + bottom) / 2}) rotate(-90)`,
        'text-anchor': 'middle' }, y.label));
    // A curve that leaves the chart ends at its edge.
    const inside = svg('g', { 'clip-path': `url(#${this.clip})` });
    parts.push(svg('clipPath', { id: this.clip }, svg('rect', { x: kLeft, y: kTop - 3, width: right - kLeft + 3, height: bottom - kTop + 6 })), inside);
    for (const s of this.visible()) inside.append(svg('path', { ...lineLook(s.style, 1.8), fill: 'none', d: this.path(s) }));
    this.drawing.replaceChildren(...parts, ...this.marks(), this.rule);
    this.show(this.at);
  }

  private barPath(s: Series): string {
    const bottom = this.height - kBottom, half = s.x.length > 1 ? (s.x[1]! - s.x[0]!) / 2 : 0;
    return s.x.map((value, i) => `${i === 0 ? `M${this.across(value - half).toFixed(1)} ${bottom}` : ''}V${this.down(s.y[i]!).toFixed(1)}H${this.across(value + half).toFixed(1)}`).join('') + `V${bottom}`;
  }

  /** Each name has a line of its own, since the places may be close together. */
  private marks(): SVGElement[] {
    const middle = (kLeft + this.width - kRight) / 2;
    return (this.content?.marks ?? []).flatMap(({ at, name }, i) => {
      const across = this.across(at), down = kTop + 12 * i + 8, isRight = across > middle;
      return [svg('line', { class: 'tick', x1: across, x2: across, y1: down - 8, y2: this.height - kBottom, 'stroke-dasharray': '2 3' }),
        svg('text', { class: 'band-label', x: across + (isRight ? -4 : 4), y: down, 'text-anchor': isRight ? 'end' : 'start' }, name)];
    });
  }

  private path(s: Series): string {
    const { x, y, bars } = this.content!;
    if (bars) return this.barPath(s);
    let path = '', pen = false;
    s.x.forEach((value, i) => {
      const height = s.y[i]!;
      const drawn = Number.isFinite(height) && value >= x.from && value <= x.to && (!y.logarithmic || height > 0);
      if (drawn) path += `${pen ? 'L' : 'M'}${this.across(value).toFixed(1)} ${this.down(height).toFixed(1)}`;
      pen = drawn;
    });
    return path;
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const xs = this.content?.series[0]?.x;
    if (!step || !xs?.length) return;
    event.preventDefault();
    const now = this.at === undefined ? (step > 0 ? -1 : xs.length) : nearest(xs, this.at);
    this.show(xs[clamp(now + step, 0, xs.length - 1)]);
  }

  /** Shows the values at the point nearest to `value`. */
  private show(value: number | undefined): void {
    this.at = value;
    const series = this.visible(), xs = series[0]?.x;
    if (value === undefined || !xs?.length || !this.content) {
      this.rule.replaceChildren();
      this.readout.textContent = 'Point at the chart, or use its arrow keys, to read values.';
      return;
    }
    const i = nearest(xs, value), at = this.across(xs[i]!);
    const there = series.map((s) => ({ name: s.name, style: s.style, y: s.x === xs ? s.y[i]! : between(s, xs[i]!) }));
    const { from, to } = this.content.y;
    const marks = there.filter((s) => s.y >= from && s.y <= to)
      .map((s) => svg('circle', { class: `marker-${s.style}`, cx: at, cy: this.down(s.y), r: 3.5 }));
    this.rule.replaceChildren(
      svg('line', { class: 'axis', x1: at, x2: at, y1: kTop, y2: this.height - kBottom }), ...marks);
    this.readout.textContent = `at ${numberText(xs[i]!, 4)}: ` +
      there.map((s) => `${s.name} ${numberText(s.y, 5)}`).join(' · ');
    this.drawing.setAttribute('aria-label', `${this.title}; ${this.readout.textContent}`);
  }
}

/** One column for x if all series share it, else the points of each series one after another. */
function rowsOf(series: readonly Series[], x: string): (string | number)[][] {
  const shared = series[0]?.x;
  if (shared && series.every((s) => s.x.length === shared.length && s.x.every((v, i) => v === shared[i])))
    return [[x, ...series.map((s) => s.name)], ...shared.map((v, i) => [v, ...series.map((s) => s.y[i]!)])];
  return [['series', x, 'value'], ...series.flatMap((s) => s.x.map((v, i) => [s.name, v, s.y[i]!]))];
}

/** The series interpolated at x; NaN outside of it. */
function between(s: Series, x: number): number {
  const after = s.x.findIndex((v, i) => v >= x && (i === 0 ? v === x : s.x[i - 1]! <= x));
  if (after <= 0) return after < 0 ? NaN : s.y[0]!;
  const from = s.x[after - 1]!, to = s.x[after]!;
  return from === to ? s.y[after]! : s.y[after - 1]! + (s.y[after]! - s.y[after - 1]!) * (x - from) / (to - from);
}

function tickText(value: number, axis: ChartAxis): string {
  if (!axis.logarithmic) {
    const size = Math.max(Math.abs(axis.from), Math.abs(axis.to));
    const digits = clamp(Math.ceil(Math.log10(size / (axis.to - axis.from))) + 3, 3, 12);
    return Math.abs(value) < 1e-9 * size ? '0' : numberText(value, digits);
  }
  // All labels of an axis in one form: 0.01 or 10⁻².
  return axis.from >= 1e-3 && axis.to <= 1e4 ? numberText(value) : powerText(Math.round(Math.log10(value)));
}

function nearest(sorted: readonly number[], value: number): number {
  let best = 0;
  for (let i = 1; i < sorted.length; ++i)
    if (Math.abs(sorted[i]! - value) < Math.abs(sorted[best]! - value)) best = i;
  return best;
}

/** Round limits of an axis that shows all finite values. */
export function rangeOf(values: Iterable<number>, logarithmic: boolean, mostDecades = 10): { from: number; to: number } {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (!Number.isFinite(value) || Math.abs(value) > 1e250 || (logarithmic && value < 1e-250)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (low > high) return logarithmic ? { from: 0.1, to: 1 } : { from: 0, to: 1 };
  if (logarithmic) {
    const to = 10 ** Math.ceil(Math.log10(high)), from = 10 ** Math.floor(Math.log10(low));
    return { from: from === to ? to / 10 : Math.max(from, to * 10 ** -mostDecades), to };
  }
  if (low === high) return { from: Math.min(0, low), to: Math.max(high, 0) || 1 };
  const steps = ticks({ label: '', from: low, to: high }, 5), step = (steps[1] ?? high) - (steps[0] ?? low);
  return { from: Math.floor(low / step) * step, to: Math.ceil(high / step) * step };
}
