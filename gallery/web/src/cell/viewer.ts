// Any two pictures of a cell: with a divider, flipped, side by side, or their difference; one zoom for all, the
// values under the cursor, and what a line across them sees.
import { Chart, rangeOf } from '../lib/chart';
import { announce, button, h, isTyping, select, svg } from '../lib/dom';
import { clamp, numberText, percentText, shortText, toNumber } from '../lib/numbers';
import { HashState } from '../lib/state';
import { cssGradient } from './colours';
import type { CellPage } from '../records';
import { GlPainter } from './gl_painter';
import { loadFloatPicture, roundingAt, type FloatPicture } from './half_picture';
import { lineAcross, sampled } from './line';
import { DifferenceMaps, valueOfMap, type LoadedMap } from './maps';
import type { Content, Look, Measure, Painter, Pane, Rectangle, Viewport } from './painter';
import { PngPainter } from './png_painter';

const kModes = [
  { value: 'slide', label: 'Divider', key: 'l' },
  { value: 'flip', label: 'Flip', key: 'f' },
  { value: 'side', label: 'Side by side', key: 's' },
  { value: 'diff', label: 'Difference', key: 'd' },
] as const;
const kMeasures = [
  { value: 'absolute', label: '|a − b|' },
  { value: 'relative', label: '|a − b| / b' },
  { value: 'signed', label: 'a − b, signed' },
] as const;
const kDecades = 6, kMostZoom = 64;
const kStops = { from: -10, to: 14 }, kMostGain = 12;
const kLeastOfMap = 2 ** -10;  // gallery/difference_maps.hpp

const kDefaults = {
  a: '', b: '', mode: 'slide', shown: 'a', ev: '', colour: '', gain: '0', measure: 'absolute',
  x: '', y: '', z: '', at: '', split: '50', line: '', scale: 'linear',
};
export type ViewerState = HashState<keyof typeof kDefaults>;
export const viewerState = (): ViewerState => new HashState(kDefaults);

export class Viewer {
  readonly element: HTMLElement;
  private readonly canvas = h('canvas', { 'aria-hidden': 'true' });
  private readonly overlay = svg('svg', { class: 'overlay', 'aria-hidden': 'true' });
  private readonly tags = h('div', { class: 'tags' });
  private readonly stage: HTMLElement;
  private readonly divider = h('input', { type: 'range', min: 0, max: 100, step: 0.5, class: 'divider', 'aria-label': 'Divider' });
  private readonly values = h('tbody');
  private readonly where = h('output', { class: 'where' });
  private readonly legend = h('div', { class: 'legend-bar' });
  private readonly message = h('p', { class: 'stage-note', role: 'status' });
  private readonly modes = h('div', { class: 'segmented', role: 'group', 'aria-label': 'How to compare' });
  private readonly exposure = h('input', { type: 'range', step: 0.25, id: 'exposure' });
  private readonly exposureName = h('label', { for: 'exposure' });
  private readonly colour = h('input', { type: 'checkbox', id: 'false-colour' });
  private readonly pick: { a: ReturnType<typeof select>; b: ReturnType<typeof select> };
  private readonly measure: ReturnType<typeof select>;
  private readonly lineChart = new Chart('Values along the line', 300);
  private readonly lineBox: HTMLElement;
  private readonly lineButton: HTMLButtonElement;

  private readonly floats = new Map<number, FloatPicture>();
  private readonly maps = new DifferenceMaps(() => this.schedule(), (words) => this.tell(words));
  private readonly loading = new Map<number, Promise<void>>();
  private painter: Painter;
  private isFloat = false;
  private isWaiting: boolean;  // for float pictures
  private width = 1;
  private height = 1;
  private cursor: { x: number; y: number } | undefined;
  private drawing = false;  // a line
  private pending = false;
  private readonly largest = new Map<string, { value: number; x: number; y: number }>();

  constructor(private readonly data: CellPage, private readonly state: ViewerState) {
    this.isWaiting = Boolean(data.engines[0]?.floatScript);
    const first = data.engines.find((e) => e.picture);
    if (first?.picture) ({ width: this.width, height: this.height } = first.picture);
    const choices = this.shownEngines().map((i) => ({
      value: data.engines[i]!.name, label: `${i + 1} ${data.engines[i]!.title}`,
    }));
    this.pick = {
      a: select('First', choices, '', (a) => this.change({ a })),
      b: select('Second', choices, '', (b) => this.change({ b })),
    };
    this.measure = select('Measure', [...kMeasures, ...this.mapChoices()], '', (measure) => this.change({ measure }));
    this.exposure.addEventListener('input', () =>
      this.change(this.mode() === 'diff' ? { gain: this.exposure.value } : { ev: this.exposure.value }));
    this.colour.addEventListener('change', () => this.change({ colour: this.colour.checked ? 'false' : '' }));
    this.divider.addEventListener('input', () => this.change({ split: this.divider.value }));
    for (const mode of kModes)
      this.modes.append(button(mode.label, () => this.change({ mode: mode.value }),
        { 'data-mode': mode.value, 'aria-keyshortcuts': mode.key, title: `${mode.label} (${mode.key})` }));
    this.lineButton = button('Draw a line', () => this.startLine(), { 'aria-keyshortcuts': 'p', title: 'Draw a line across the picture (p)', 'aria-pressed': 'false' });
    this.stage = h('div', {
      class: 'stage', tabindex: 0, role: 'application', 'aria-roledescription': 'picture viewer',
      'aria-label': 'The two pictures. Arrow keys move the cursor, with Shift the picture; plus and minus zoom, 0 fits.',
    }, this.canvas, this.overlay, this.tags);
    this.lineBox = h('figure', { class: 'line-box', hidden: true }, h('figcaption', {}, ''), this.lineChart.element);
    this.element = h('section', { class: 'viewer', 'aria-labelledby': 'viewer' },
      h('h2', { id: 'viewer' }, 'Compare'),
      h('div', { class: 'viewer-grid' },
        h('div', { class: 'stage-column' },
          h('div', { class: 'controls' }, this.pick.a.element,
            button('⇄', () => this.exchange(),
              { 'aria-label': 'Exchange the two', title: 'Exchange the two (x)', 'aria-keyshortcuts': 'x' }),
            this.pick.b.element, this.modes),
          this.stage, this.divider, this.legend, this.message),
        h('div', { class: 'side-panel' },
          h('div', { class: 'controls' },
            h('div', { class: 'exposure' }, this.exposureName, this.exposure),
            h('label', { class: 'check' }, this.colour, 'False colour'),
            this.measure.element),
          h('div', { class: 'controls', role: 'group', 'aria-label': 'Zoom' },
            button('−', () => this.zoomBy(0.5), { 'aria-label': 'Zoom out' }),
            button('+', () => this.zoomBy(2), { 'aria-label': 'Zoom in' }),
            button('Fit', () => this.fit()), button('1 : 1', () => this.zoomTo(1)),
            button('Worst pixel', () => this.goToWorst(), { title: 'Where the two differ most (w)', 'aria-keyshortcuts': 'w' })),
          h('div', { class: 'controls', role: 'group', 'aria-label': 'A line across the picture' },
            this.lineButton,
            button('Row', () => this.lineThrough(true), { title: 'The row of the cursor' }),
            button('Column', () => this.lineThrough(false), { title: 'The column of the cursor' }),
            button('None', () => this.change({ line: '' }), { title: 'No line' })),
          h('table', { class: 'pixel-values' },
            h('caption', {}, this.where),
            h('thead', {}, h('tr', {}, ...['', 'red', 'green', 'blue'].map((c) => h('th', { scope: 'col' }, c || h('span', { class: 'unseen' }, 'picture'))))),
            this.values),
          this.keysHelp())),
      this.lineBox);

    this.painter = new PngPainter(this.canvas, data, () => this.schedule(), () => this.isWaiting);
    this.listen();
    state.onChange(() => { this.cursor = undefined; this.refresh(); });
    new ResizeObserver(() => this.schedule()).observe(this.stage);
    this.refresh();
  }

  private keysHelp(): HTMLElement {
    const keys: readonly (readonly [string, string])[] = [
      ['1 … 9', 'first picture; with Shift the second'], ['f', 'flip between the two'], ['l s d', 'divider, side by side, difference'],
      ['x', 'exchange the two'], ['e E', 'brighter, darker'], ['c', 'false colour'], ['+ − 0', 'zoom in, out, fit'], ['w', 'where the two differ most'], ['p', 'draw a line'],
    ];
    return h('details', { class: 'keys' }, h('summary', {}, 'Keys'),
      h('dl', {}, ...keys.map(([key, what]) => h('div', {}, h('dt', {}, h('kbd', {}, key)), h('dd', {}, what)))));
  }

  // ---- what is chosen

  private shownEngines(): number[] {
    return this.data.engines.flatMap((e, i) => (e.picture ? [i] : []));
  }

  private chosen(which: 'a' | 'b'): number {
    const shown = this.shownEngines();
    const named = this.data.engines.findIndex((e) => e.name === this.state.get(which) && e.picture);
    if (named >= 0) return named;
    // Ours, and the one that is furthest from being ours: an engine, not the formula.
    const others = shown.filter((i) => i !== shown[0]);
    return (which === 'a' ? shown[0] : others.find((i) => this.data.engines[i]!.name !== 'analytic') ?? others[0]) ?? 0;
  }

  private exchange(): void {
    const name = (which: 'a' | 'b'): string => this.data.engines[this.chosen(which)]!.name;
    this.change({ a: name('b'), b: name('a') });
  }

  private mode(): (typeof kModes)[number]['value'] {
    return kModes.find((m) => m.value === this.state.get('mode'))?.value ?? 'slide';
  }

  private measureOf(): Measure { return kMeasures.find((m) => m.value === this.state.get('measure'))?.value ?? 'absolute'; }

  /** Maps by a metric that this cell has of some pair. */
  private mapChoices(): { value: string; label: string }[] {
    const titles = new Map(this.data.comparisons.flatMap((c) => c.maps.map((m) => [m.id, m.title] as const)));
    return [...titles].map(([value, label]) => ({ value, label }));
  }

  private mapAsked(): { value: string; label: string } | undefined {
    const measure = this.state.get('measure');
    return kMeasures.some((m) => m.value === measure) ? undefined : this.mapChoices().find((m) => m.value === measure);
  }

  /** Where it is asked for, there of these two, and has come. */
  private mapOf(a: number, b: number): LoadedMap | undefined {
    const asked = this.mode() === 'diff' && this.isFloat ? this.mapAsked() : undefined;
    const map = asked && this.comparisonOf(a, b)?.maps.find((m) => m.id === asked.value);
    return map && this.maps.of(map);
  }

  private change(changes: Parameters<ViewerState['set']>[0]): void {
    this.state.set(changes);
    this.refresh();
  }

  /** Everything that shows the state. */
  private refresh(): void {
    const a = this.chosen('a'), b = this.chosen('b'), mode = this.mode();
    this.pick.a.set(this.data.engines[a]?.name ?? '');
    this.pick.b.set(this.data.engines[b]?.name ?? '');
    this.measure.set(this.mapAsked()?.value ?? this.measureOf());
    this.measure.element.hidden = mode !== 'diff';
    for (const control of this.modes.querySelectorAll('button'))
      control.setAttribute('aria-pressed', String(control.dataset['mode'] === mode));
    this.divider.hidden = mode !== 'slide';
    this.divider.value = this.state.get('split');
    this.colour.checked = this.state.get('colour') === 'false';
    const base = this.baseStops();
    this.exposure.min = String(mode === 'diff' ? -kMostGain : base + kStops.from);
    this.exposure.max = String(mode === 'diff' ? kMostGain : base + kStops.to);
    const chosen = mode === 'diff' ? this.gain() : this.stops();
    this.exposure.value = String(chosen);  // which has steps
    const stops = numberText(Math.round(100 * chosen) / 100, 5);
    this.exposureName.textContent = mode === 'diff' ? `Gain of the difference ${stops} stops` : `Exposure ${stops} stops`;
    // A finger scrolls the page, but over an enlarged picture or with a line to draw.
    this.stage.style.touchAction = this.state.get('z') === '' && !this.drawing ? 'pan-y pinch-zoom' : 'none';
    for (const which of [a, b, 0]) void this.need(which);
    this.schedule();
  }

  private baseStops(): number {
    const stops = toNumber(this.data.exposureStops);
    return Number.isFinite(stops) ? stops : 0;
  }

  private stops(): number {
    const base = this.baseStops();
    return this.state.get('ev') === '' ? base : clamp(this.state.number('ev'), base + kStops.from, base + kStops.to);
  }

  private gain(): number { return clamp(this.state.number('gain'), -kMostGain, kMostGain); }

  // ---- pictures

  private need(engine: number): Promise<void> {
    const known = this.loading.get(engine);
    if (known) return known;
    const promise = this.loadOne(engine);
    this.loading.set(engine, promise);
    return promise;
  }

  private async loadOne(engine: number): Promise<void> {
    const source = this.data.engines[engine]?.floatScript;
    if (!source) {
      if (engine === 0 || this.isFloat) this.tell('This gallery has no float pictures here: exposure, false colour and values need them.');
      return;
    }
    try {
      this.floats.set(engine, await loadFloatPicture(source));
      this.useFloats();
    } catch (error) {
      if (engine === 0) this.isWaiting = false;
      this.tell(error instanceof Error ? error.message : String(error));
    }
    this.schedule();
  }

  private useFloats(): void {
    const ours = this.floats.get(0);
    if (!ours) return;
    if (!this.isFloat) {
      const canvas = h('canvas', { 'aria-hidden': 'true' });
      const gl = canvas.getContext('webgl2', { antialias: false, depth: false, preserveDrawingBuffer: true });
      if (gl) {
        try {
          this.painter = new GlPainter(canvas, gl, this.floats);
          this.canvas.replaceWith(canvas);
          Object.assign(this, { canvas });
          this.isFloat = true;
        } catch {
          // Told below.
        }
      }
      this.isWaiting = this.isFloat;
      if (!this.isFloat) this.tell('This browser has no WebGL 2: pictures are shown as 8-bit files, without exposure and false colour.');
      ({ width: this.width, height: this.height } = ours);
    }
    this.stage.dataset['ready'] = String(this.floats.size);
  }

  private tell(words: string): void { this.message.textContent = words; }

  /** Red, green and blue; undefined where the picture is not there. */
  private valueAt(engine: number, x: number, y: number): [number, number, number] | undefined {
    const picture = this.floats.get(engine), ours = this.floats.get(0);
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
  private valueText(engine: number, x: number, y: number, c: number, value: number): string {
    const picture = this.floats.get(engine), ours = this.floats.get(0);
    if (!picture || !ours || value === 0 || !Number.isFinite(value)) return shortText(value);
    const at = 3 * (y * picture.width + x) + c;
    const rounding = roundingAt(ours, ours.values[at]!) + (picture.fromOurs ? roundingAt(picture, picture.values[at]!) : 0);
    return shortText(value, clamp(1 + Math.floor(Math.log10(Math.abs(value) / rounding)), 1, 4));
  }

  private differenceAt(a: number, b: number, x: number, y: number): [number, number, number] | undefined {
    const first = this.floats.get(a), second = this.floats.get(b);
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
  private largestOf(a: number, b: number, measure: Measure | 'value'): number {
    return this.worst(a, b, measure)?.value || 1;
  }

  /** And where it is; undefined until the pictures are there. */
  private worst(a: number, b: number, measure: Measure | 'value'): { value: number; x: number; y: number } | undefined {
    const key = `${a} ${b} ${measure}`, known = this.largest.get(key);
    if (known) return known;
    const first = this.floats.get(a), second = this.floats.get(b), ours = this.floats.get(0);
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

  private comparisonOf(a: number, b: number): CellPage['comparisons'][number] | undefined {
    const names = [this.data.engines[a]?.name, this.data.engines[b]?.name];
    return a === b ? undefined : this.data.comparisons.find((c) => names.includes(c.a) && names.includes(c.b) && c.a !== c.b);
  }

  /** As it was recorded, from all bits; of two that were not compared, as this page has them. */
  private worstPixel(a: number, b: number): { x: number; y: number; value: number } | undefined {
    const map = this.mapOf(a, b);
    if (map) return map.worst;
    if (this.mode() === 'diff' && this.measureOf() === 'relative') return this.worst(a, b, 'relative');
    const found = this.worst(a, b, 'absolute'), record = this.comparisonOf(a, b);
    const x = toNumber(record?.worstX), y = toNumber(record?.worstY);
    return found && Number.isInteger(x) && Number.isInteger(y) ? { ...found, x: clamp(x, 0, this.width - 1), y: clamp(y, 0, this.height - 1) } : found;
  }

  private goToWorst(): void {
    const worst = this.worstPixel(this.chosen('a'), this.chosen('b'));
    if (!worst) return;
    this.setCursor(worst.x, worst.y, true);
    if (this.state.get('z') !== '') this.change({ x: String(worst.x + 0.5), y: String(worst.y + 0.5) });
    announce(`Largest difference at pixel ${worst.x}, ${worst.y}: ${numberText(worst.value)}`);
  }

  /** What white stands for in a difference. */
  private white(a: number, b: number): number {
    const map = this.mapOf(a, b);
    // What nobody notices stays dark, however large it is beside the rest.
    if (map) return Math.max(1, map.worst.value) / 2 ** this.gain();
    const measure = this.measureOf(), whiteAt = toNumber(this.comparisonOf(a, b)?.whiteAt);
    const base = measure !== 'relative' && whiteAt > 0 ? whiteAt : this.isFloat ? this.largestOf(a, b, measure) : 1;
    return base / 2 ** this.gain();
  }

  // ---- painting

  private schedule(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => { this.pending = false; this.paint(); });
  }

  private rectangles(): Rectangle[] {
    const box = this.stage.getBoundingClientRect(), scale = devicePixelRatio;
    const width = Math.max(4, Math.round(box.width * scale)), height = Math.max(1, Math.round(box.height * scale));
    if (this.mode() !== 'side') return [{ x: 0, y: 0, width, height }];
    const half = Math.max(1, Math.floor(width / 2) - 1);
    return [{ x: 0, y: 0, width: half, height }, { x: half + 2, y: 0, width: width - half - 2, height }];
  }

  private fitZoom(): number {
    const at = this.rectangles()[0]!;
    return Math.min(at.width / this.width, at.height / this.height);
  }

  private view(): Viewport {
    const at = this.rectangles()[0]!;
    const zoom = this.state.get('z') === '' ? this.fitZoom() : clamp(this.state.number('z') * devicePixelRatio, this.fitZoom() / 4, kMostZoom * 4);
    const x = this.state.get('x') === '' ? this.width / 2 : this.state.number('x');
    const y = this.state.get('y') === '' ? this.height / 2 : this.state.number('y');
    return { x: x - at.width / 2 / zoom, y: y - at.height / 2 / zoom, zoom };
  }

  private paint(): void {
    const panes = this.rectangles(), view = this.view(), mode = this.mode();
    const a = this.chosen('a'), b = this.chosen('b'), all = panes[0]!;
    const picture = (engine: number): Content => ({ kind: 'picture', engine });
    const list: Pane[] = [];
    const isFlipped = mode === 'flip' && this.state.get('shown') === 'b';
    if (mode === 'slide') {
      const left = Math.round(all.width * clamp(this.state.number('split'), 0, 100) / 100);
      list.push({ at: { ...all, width: left }, view, content: picture(a) });
      list.push({ at: { ...all, x: left, width: all.width - left }, view: { ...view, x: view.x + left / view.zoom }, content: picture(b) });
    } else if (mode === 'side') {
      list.push({ at: panes[0]!, view, content: picture(a) }, { at: panes[1]!, view, content: picture(b) });
    } else if (mode === 'flip') {
      list.push({ at: all, view, content: picture(isFlipped ? b : a) });
    } else {
      const map = this.mapOf(a, b), white = this.white(a, b);
      list.push({ at: all, view, content: map ? { kind: 'map', picture: map.picture, white } : { kind: 'difference', a, b, measure: this.measureOf(), white } });
    }
    const width = mode === 'side' ? panes[1]!.x + panes[1]!.width : all.width;
    this.painter.paint(width, all.height, list, this.look(a, b));
    this.showTags(mode, a, b, isFlipped);
    this.showLegend(mode, a, b);
    this.showValues(a, b);
    this.showOverlay(panes, view, this.cursorNow(a, b));
    this.showLine(a, b);
  }

  private look(a: number, b: number): Look {
    const isDifference = this.mode() === 'diff';
    return {
      stops: this.stops(), falseColour: this.isFloat && this.state.get('colour') === 'false', decades: kDecades,
      top: !this.isFloat ? 1 : isDifference ? this.white(a, b) : this.largestOf(0, 0, 'value') * 2 ** (this.baseStops() - this.stops()),
    };
  }

  private showTags(mode: string, a: number, b: number, isFlipped: boolean): void {
    const title = (engine: number): string => this.data.engines[engine]?.title ?? '';
    const words = mode === 'diff' ? [`${title(a)} − ${title(b)}`] : mode === 'flip' ? [title(isFlipped ? b : a)] : [title(a), title(b)];
    this.tags.replaceChildren(...words.map((w) => h('span', {}, w)));
    this.tags.className = 'tags ' + mode;
  }

  private showLegend(mode: string, a: number, b: number): void {
    const ramp = h('span', { class: 'ramp' });
    const isFalse = this.state.get('colour') === 'false' && this.isFloat;
    const map = this.mapOf(a, b);
    if (map) {
      const white = this.white(a, b), { least, block, mantissaBits } = map.picture;
      ramp.style.background = cssGradient('magma');
      this.legend.replaceChildren(h('span', {}, isFalse ? numberText(white * 10 ** -kDecades) : '0'), ramp, h('span', {}, numberText(white)),
        h('span', {}, `${map.title}: ${map.meaning}; the largest is ${numberText(map.worst.value)}, and what is under ${numberText(Math.max(least, kLeastOfMap))} counts as 0${mantissaBits < 4 ? `; to ± ${percentText(2 ** -(mantissaBits + 1))}` : ''}${block > 1 ? `; each ${block} × ${block} pixels by their largest` : ''}`));
    } else if (mode === 'diff') {
      const white = this.white(a, b), measure = this.measureOf(), peak = this.isFloat ? this.largestOf(b, b, 'value') : NaN;
      if (measure === 'signed') ramp.style.background = 'linear-gradient(to right, rgb(76 166 255), rgb(15 15 15), rgb(255 115 51))';
      else if (isFalse) ramp.style.background = cssGradient('inferno');
      const low = measure === 'signed' ? '−' + numberText(white) : isFalse ? numberText(white * 10 ** -kDecades) : '0';
      const share = measure === 'relative' ? percentText(white) : numberText(white) + (Number.isFinite(peak) ? ` = ${percentText(white / peak)} of the peak` : '');
      this.legend.replaceChildren(h('span', {}, low), ramp, h('span', {}, share), this.missingMap() ?? this.precisionNote(a, b));
    } else if (isFalse) {
      const { top } = this.look(a, b);
      ramp.style.background = cssGradient('viridis');
      this.legend.replaceChildren(h('span', {}, numberText(top * 10 ** -kDecades)), ramp, h('span', {}, numberText(top) + ', logarithmic'));
    } else {
      this.legend.replaceChildren(h('span', {}, `radiance times ${numberText(2 ** this.stops())}, as sRGB`));
    }
  }

  /** Why the difference of values stands in place of a map that was asked for. */
  private missingMap(): HTMLElement | undefined {
    const asked = this.mapAsked(), there = asked && this.comparisonOf(this.chosen('a'), this.chosen('b'))?.maps.some((m) => m.id === asked.value);
    return !asked ? undefined : h('span', {}, there ? this.isFloat ? `${asked.label} is on its way` : `${asked.label} needs float pictures and WebGL 2`
      : `|a − b|: ${asked.label} was made of ours and each engine`);
  }

  /** How exactly this page has a difference: differences from ours are stored as such. */
  private precisionNote(a: number, b: number): HTMLElement {
    const stored = [a, b].flatMap((i) => { const p = this.floats.get(i); return p?.fromOurs ? [p] : []; });
    if (stored.length === 0) return h('span', {}, this.isFloat || a === b ? '' : 'the recorded picture');
    const bits = Math.min(...stored.map((p) => p.mantissaBits)), least = Math.max(...stored.map((p) => p.least));
    return h('span', {}, `to ± ${percentText(2 ** -(bits + 1))}${least > 0 ? `, nothing under ${numberText(least)}` : ''} of what float32 has`);
  }

  private showValues(a: number, b: number): void {
    const cursor = this.cursorNow(a, b);
    if (!cursor || !this.isFloat) {
      this.where.textContent = this.isFloat ? 'Point at a pixel to read its values' : 'Values need float pictures';
      this.values.replaceChildren();
      return;
    }
    const { x, y } = cursor;
    const worst = this.worstPixel(a, b);
    const isWorst = a !== b && worst?.x === x && worst.y === y && worst.value > 0;
    this.where.textContent = `Pixel (${x}, ${y})${isWorst ? ', where they differ most' : ''}`;
    const row = (name: string, value: readonly number[] | undefined, text: (value: number, c: number) => string, chosen: string): HTMLElement =>
      h('tr', { class: chosen }, h('th', { scope: 'row' }, name),
        ...[0, 1, 2].map((c) => h('td', {}, value ? text(value[c]!, c) : '…')));
    const rows = this.shownEngines().filter((i) => this.data.engines[i]!.floatScript).map((i) => {
      void this.need(i);
      return row(this.data.engines[i]!.shortTitle, this.valueAt(i, x, y), (value, c) => this.valueText(i, x, y, c, value), i === a || i === b ? 'chosen' : '');
    });
    rows.push(row('Difference', this.differenceAt(a, b, x, y), (value) => shortText(value), 'sum'));
    const map = this.mapOf(a, b), mapped = map && valueOfMap(map, x, y);
    if (map && mapped !== undefined)
      rows.push(h('tr', { class: 'sum' }, h('th', { scope: 'row' }, map.title), h('td', { colspan: 3 }, shortText(mapped, 3))));
    this.values.replaceChildren(...rows);
  }

  private showOverlay(panes: readonly Rectangle[], view: Viewport, cursor: { x: number; y: number } | undefined): void {
    const scale = devicePixelRatio, parts: SVGElement[] = [];
    const line = this.line();
    for (const pane of panes) {
      const across = (x: number): number => (pane.x + (x - view.x) * view.zoom) / scale;
      const down = (y: number): number => (pane.y + (y - view.y) * view.zoom) / scale;
      if (line) {
        const ends = { x1: across(line.x0 + 0.5), y1: down(line.y0 + 0.5), x2: across(line.x1 + 0.5), y2: down(line.y1 + 0.5) };
        parts.push(svg('line', { ...ends, class: 'line-halo' }), svg('line', { ...ends, class: 'line' }));
      }
      if (cursor) {
        const size = Math.max(view.zoom / scale, 5), middle = 0.5 - size * scale / view.zoom / 2;
        parts.push(svg('rect', { class: 'pixel', x: across(cursor.x + middle), y: down(cursor.y + middle), width: size, height: size }));
      }
    }
    if (this.mode() === 'slide') {
      const at = `${clamp(this.state.number('split'), 0, 100)}%`;
      parts.push(svg('line', { class: 'line-halo', x1: at, x2: at, y1: 0, y2: '100%' }), svg('line', { class: 'split', x1: at, x2: at, y1: 0, y2: '100%' }));
    }
    this.overlay.replaceChildren(...parts);
  }

  // ---- a line across the picture

  private line(): { x0: number; y0: number; x1: number; y1: number } | undefined {
    const ends = this.state.get('line').split(',').map(Number);
    if (ends.length !== 4 || !ends.every((v) => Number.isFinite(v) && Math.abs(v) < 1e6)) return undefined;
    return { x0: ends[0]!, y0: ends[1]!, x1: ends[2]!, y1: ends[3]! };
  }

  private startLine(): void {
    this.drawing = !this.drawing;
    if (this.drawing) announce('Draw a line across the picture with the pointer.');
    this.lineButton.setAttribute('aria-pressed', String(this.drawing));
    this.stage.classList.toggle('drawing', this.drawing);
  }

  private lineThrough(isRow: boolean): void {
    const { x, y } = this.cursorNow(this.chosen('a'), this.chosen('b')) ?? { x: Math.floor(this.width / 2), y: Math.floor(this.height / 2) };
    this.change({ line: isRow ? `0,${y},${this.width - 1},${y}` : `${x},0,${x},${this.height - 1}` });
  }

  private shownLine = '';
  private showLine(a: number, b: number): void {
    const line = this.line();
    this.lineBox.hidden = !line || !this.isFloat;
    const key = `${this.state.get('line')} ${a} ${b} ${this.floats.size}`;
    if (!line || !this.isFloat || key === this.shownLine) return;
    this.shownLine = key;
    const points = lineAcross(line, this.width, this.height);
    const series = [...new Set([a, b])].filter((i) => this.floats.has(i)).map((i) => ({
      name: this.data.engines[i]!.shortTitle, style: 1 + i % 5, ...sampled(points, (x, y) => this.valueAt(i, x, y)),
    }));
    const xs = series[0]?.x ?? [];
    this.lineChart.update({
      x: { label: 'pixels along the line', from: 0, to: Math.max(1, xs[xs.length - 1] ?? 1) },
      y: { label: 'radiance (mean of R, G, B)', ...rangeOf(series.flatMap((s) => s.y), false) }, series,
    });
    this.lineBox.querySelector('figcaption')!.textContent =
      `From pixel (${line.x0}, ${line.y0}) to (${line.x1}, ${line.y1}): the mean of red, green and blue of the pixels on the line.`;
  }

  // ---- zoom, pan, keys

  private zoomTo(zoom: number, about?: { x: number; y: number }): void {
    const view = this.view(), at = this.rectangles()[0]!;
    const next = clamp(zoom * devicePixelRatio, Math.min(this.fitZoom(), 1), kMostZoom * devicePixelRatio);
    const centre = { x: view.x + at.width / 2 / view.zoom, y: view.y + at.height / 2 / view.zoom };
    // What is under the pointer stays there.
    const fixed = about ?? centre, share = view.zoom / next;
    this.moveTo(fixed.x + (centre.x - fixed.x) * share, fixed.y + (centre.y - fixed.y) * share, next / devicePixelRatio);
  }

  private zoomBy(factor: number, about?: { x: number; y: number }): void {
    this.zoomTo(this.view().zoom / devicePixelRatio * factor, about);
  }

  private moveTo(x: number, y: number, zoom: number): void {
    this.change({
      x: clamp(x, 0, this.width).toFixed(2), y: clamp(y, 0, this.height).toFixed(2), z: String(Number(zoom.toPrecision(5))),
    });
  }

  private fit(): void { this.change({ x: '', y: '', z: '' }); }

  /** The picture's point under the pointer. */
  private pointAt(event: { clientX: number; clientY: number }): { x: number; y: number } {
    const box = this.stage.getBoundingClientRect(), view = this.view(), scale = devicePixelRatio;
    const across = (event.clientX - box.left) * scale, down = (event.clientY - box.top) * scale;
    const panes = this.rectangles(), pane = panes.filter((r) => across >= r.x).at(-1) ?? panes[0]!;
    return { x: view.x + (across - pane.x) / view.zoom, y: view.y + (down - pane.y) / view.zoom };
  }

  /** Under the pointer; else where the link says; else where the two differ most. */
  private cursorNow(a: number, b: number): { x: number; y: number } | undefined {
    const [x = NaN, y = NaN] = this.state.get('at').split(',').map(Number);
    const linked = Number.isInteger(x) && Number.isInteger(y) && x >= 0 && y >= 0 && x < this.width && y < this.height;
    return this.cursor ?? (linked ? { x, y } : this.isFloat ? this.worstPixel(a, b) : undefined);
  }

  /** `keep`: a link has it too. */
  private setCursor(x: number, y: number, keep = false): void {
    this.cursor = { x: clamp(Math.floor(x), 0, this.width - 1), y: clamp(Math.floor(y), 0, this.height - 1) };
    if (keep) this.state.set({ at: `${this.cursor.x},${this.cursor.y}` });
    this.schedule();
  }

  private listen(): void {
    let held: { x: number; y: number; kind: 'pan' | 'line' | 'split' } | undefined;
    const isAtDivider = (event: PointerEvent): boolean => {
      const box = this.stage.getBoundingClientRect();
      return this.mode() === 'slide' && Math.abs(event.clientX - box.left - box.width * this.state.number('split') / 100) < 12;
    };
    this.stage.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      const point = this.pointAt(event);
      held = { ...point, kind: this.drawing ? 'line' : isAtDivider(event) ? 'split' : 'pan' };
      this.stage.setPointerCapture(event.pointerId);
    });
    this.stage.addEventListener('pointermove', (event) => {
      const point = this.pointAt(event);
      this.setCursor(point.x, point.y);
      this.stage.classList.toggle('at-divider', held?.kind === 'split' || (!held && isAtDivider(event)));
      if (!held) return;
      if (held.kind === 'line') {
        this.change({ line: [held.x, held.y, point.x, point.y].map((v, i) => clamp(Math.floor(v), 0, (i % 2 ? this.height : this.width) - 1)).join(',') });
      } else if (held.kind === 'split') {
        const box = this.stage.getBoundingClientRect();
        this.change({ split: clamp(100 * (event.clientX - box.left) / box.width, 0, 100).toFixed(1) });
      } else {
        const view = this.view(), at = this.rectangles()[0]!;
        this.moveTo(view.x + at.width / 2 / view.zoom + held.x - point.x, view.y + at.height / 2 / view.zoom + held.y - point.y, view.zoom / devicePixelRatio);
      }
    });
    const release = (): void => {
      if (held?.kind === 'line') this.startLine();
      else if (held?.kind === 'pan' && this.cursor) this.setCursor(this.cursor.x, this.cursor.y, true);
      held = undefined;
    };
    this.stage.addEventListener('pointerup', release);
    this.stage.addEventListener('pointercancel', release);
    this.stage.addEventListener('wheel', (event) => {
      // Without Ctrl the page scrolls, unless the reader is at work on the picture.
      if (!event.ctrlKey && document.activeElement !== this.stage) return;
      event.preventDefault();
      this.zoomBy(2 ** (-event.deltaY / 240), this.pointAt(event));
    }, { passive: false });
    this.stage.addEventListener('dblclick', (event) => this.zoomBy(2, this.pointAt(event)));
    this.stage.addEventListener('keydown', (event) => this.arrow(event));
    document.addEventListener('keydown', (event) => this.key(event));
  }

  private arrow(event: KeyboardEvent): void {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const [dx = 0, dy = 0] = step;
    if (event.shiftKey) {
      const view = this.view(), at = this.rectangles()[0]!;
      const stride = at.width / view.zoom / 8;
      this.moveTo(view.x + at.width / 2 / view.zoom + dx * stride, view.y + at.height / 2 / view.zoom + dy * stride, view.zoom / devicePixelRatio);
      return;
    }
    const { x, y } = this.cursorNow(this.chosen('a'), this.chosen('b')) ?? { x: Math.floor(this.width / 2), y: Math.floor(this.height / 2) };
    this.setCursor(x + dx, y + dy, true);
    const ours = this.valueAt(this.chosen('a'), this.cursor!.x, this.cursor!.y);
    if (ours) announce(`Pixel ${this.cursor!.x}, ${this.cursor!.y}: ${ours.map((v) => numberText(v)).join(', ')}`);
  }

  private key(event: KeyboardEvent): void {
    if (isTyping(event)) return;
    const digit = /^(?:Digit|Numpad)([1-9])$/.exec(event.code)?.[1];
    const picked = digit ? this.data.engines[Number(digit) - 1] : undefined;
    if (picked?.picture) {
      this.change(event.shiftKey ? { b: picked.name } : { a: picked.name, shown: 'a' });
      announce(picked.title);
      return event.preventDefault();
    }
    const stops = this.mode() === 'diff' ? 'gain' : 'ev';
    const now = this.mode() === 'diff' ? this.gain() : this.stops();
    const brighten = (by: number): void => {
      this.change({ [stops]: String(now + by) });
      this.change({ [stops]: String(this.mode() === 'diff' ? this.gain() : this.stops()) });
    };
    const acts: Record<string, () => void> = {
      f: () => this.change({ mode: 'flip', shown: this.mode() === 'flip' && this.state.get('shown') === 'a' ? 'b' : 'a' }),
      l: () => this.change({ mode: 'slide' }), s: () => this.change({ mode: 'side' }), d: () => this.change({ mode: 'diff' }),
      x: () => this.exchange(),
      e: () => brighten(0.5), E: () => brighten(-0.5),
      Escape: () => { if (this.drawing) this.startLine(); },
      c: () => this.change({ colour: this.state.get('colour') === 'false' ? '' : 'false' }),
      '+': () => this.zoomBy(2), '=': () => this.zoomBy(2), '-': () => this.zoomBy(0.5), '0': () => this.fit(),
      p: () => this.startLine(), w: () => this.goToWorst(),
    };
    const act = Object.hasOwn(acts, event.key) ? acts[event.key] : undefined;
    if (!act) return;
    act();
    event.preventDefault();
  }
}
