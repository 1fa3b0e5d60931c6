// Compares two pictures of a cell: with a divider, flipped, side by side, or their difference. Shows the values under the
// cursor and along a line.
import { announce, button, h, select, svg } from '../lib/dom';
import { figureButton } from '../lib/figure';
import { enlargement } from '../lib/figure_svg';
import { clamp, numberText } from '../lib/numbers';
import type { CellPage } from '../records';
import { Camera } from './camera';
import { Choice, kMeasures, kModes, kMostGain, kStops, type LinkState } from './choice';
import { figureOf } from './figure';
import { Flipper } from './flipper';
import { FloatPainter } from './float_painter';
import { FloatPictures } from './float_pictures';
import { legendOf } from './legend';
import { Histogram } from './histogram';
import { LineBox } from './line_box';
import { MapHistogram } from './map_histogram';
import { DifferenceMaps } from './maps';
import { overlayOf } from './overlay';
import type { Content, Painter, Pane } from './painter';
import { PixelValues } from './pixel_values';
import { PngPainter } from './png_painter';
import { RegionOutline } from './region';
import { listenToKeys, listenToPointer, type Controls } from './viewer_input';
import { ViewerState } from './viewer_state';

export class Viewer implements Controls {
  readonly element: HTMLElement;
  private readonly canvas = h('canvas', { 'aria-hidden': 'true' });
  private readonly overlay = svg('svg', { class: 'overlay', 'aria-hidden': 'true' });
  private readonly tags = h('div', { class: 'tags' });
  readonly stage: HTMLElement;
  private readonly divider = h('input', { type: 'range', min: 0, max: 100, step: 0.5, class: 'divider', 'aria-label': 'Divider' });
  private readonly values = new PixelValues();
  private readonly legend = h('div', { class: 'legend-bar' });
  private readonly message = h('p', { class: 'stage-note', role: 'status' });
  private readonly modes = h('div', { class: 'segmented', role: 'group', 'aria-label': 'How to compare' });
  private readonly exposure = h('input', { type: 'range', step: 0.25, id: 'exposure' });
  private readonly exposureName = h('label', { for: 'exposure' });
  private readonly colour = h('input', { type: 'checkbox', id: 'false-colour' });
  private readonly pick: { a: ReturnType<typeof select>; b: ReturnType<typeof select> };
  private readonly measure: ReturnType<typeof select>;
  private readonly lineBox = new LineBox();
  private readonly histogram = new Histogram(() => this.schedule());
  private readonly mapHistogram = new MapHistogram();
  private readonly outline = new RegionOutline(() => this.schedule());
  private readonly region = h('input', { type: 'checkbox', id: 'region' });
  private readonly lineButton: HTMLButtonElement;

  private painter: Painter;
  private isWaiting: boolean;  // for float pictures
  readonly state: ViewerState;
  readonly flipper: Flipper;
  private readonly choice: Choice;
  private readonly camera: Camera;
  private readonly pictures: FloatPictures;
  isDrawing = false;
  private pending = false;

  constructor(private readonly data: CellPage, private readonly link: LinkState) {
    this.choice = new Choice(data, link);
    this.flipper = new Flipper(this.choice, (changes) => this.change(changes));
    this.pictures = new FloatPictures(data, () => { this.useFloats(); this.schedule(); },
      (engine, why) => this.lacks(engine, why));
    this.isWaiting = Boolean(data.engines[0]?.floatScript);
    const choices = this.choice.engines().map((i) => ({
      value: data.engines[i]!.name, label: `${i + 1} ${data.engines[i]!.title}`,
    }));
    this.pick = {
      a: select('First', choices, '', (a) => this.change({ a })),
      b: select('Second', choices, '', (b) => this.change({ b })),
    };
    this.measure = select('Measure', [...kMeasures, ...this.choice.mapChoices()], '', (measure) => this.change({ measure }));
    this.exposure.addEventListener('input', () =>
      this.change(this.choice.mode() === 'diff' ? { gain: this.exposure.value } : { ev: this.exposure.value }));
    this.colour.addEventListener('change', () => this.change({ colour: this.colour.checked ? 'false' : '' }));
    this.region.addEventListener('change', () => this.change({ region: this.region.checked ? 'on' : 'off' }));
    this.divider.addEventListener('input', () => this.change({ split: this.divider.value }));
    for (const mode of kModes)
      this.modes.append(button(mode.label, () => this.setMode(mode.value),
        { 'data-mode': mode.value, 'aria-keyshortcuts': mode.key, title: `${mode.label} (${mode.key})` }));
    this.lineButton = button('Draw a line', () => this.startLine(), { 'aria-keyshortcuts': 'p', title: 'Draw a line across the picture (p)', 'aria-pressed': 'false' });
    this.stage = h('div', {
      class: 'stage', tabindex: 0, role: 'application', 'aria-roledescription': 'picture viewer',
      'aria-label': 'The two pictures. Arrow keys move the cursor, with Shift the picture; plus and minus zoom, 0 fits.',
    }, this.canvas, this.overlay, this.tags);
    this.camera = new Camera(this.stage, this.choice, (changes) => this.change(changes));
    this.state = new ViewerState(this.choice, this.camera, this.pictures, new DifferenceMaps(() => this.schedule(), (words) => this.tell(words)));
    const first = data.engines.find((e) => e.picture)?.picture;
    if (first) this.camera.size = first;
    this.element = h('section', { class: 'viewer', 'aria-labelledby': 'viewer' },
      h('h2', { id: 'viewer' }, 'Compare'),
      h('div', { class: 'viewer-grid' },
        h('div', { class: 'stage-column' },
          h('div', { class: 'controls' }, this.pick.a.element,
            button('⇄', () => this.exchange(),
              { 'aria-label': 'Exchange the two', title: 'Exchange the two (x)', 'aria-keyshortcuts': 'x' }),
            this.pick.b.element,
            ...(this.choice.oldAgainstNew().length > 0 ? [button('Old against new', () => this.showOldAgainstNew(),
              { title: 'The earlier run’s picture beside this one’s; again for the next engine (b)', 'aria-keyshortcuts': 'b' })] : []), this.modes, this.flipper.button, figureButton('what the viewer shows', () => figureOf(this.state, this.painted()))),
          this.stage, this.divider, this.legend, this.message),
        h('div', { class: 'side-panel' },
          h('div', { class: 'controls' },
            h('div', { class: 'exposure' }, this.exposureName, this.exposure),
            h('label', { class: 'check' }, this.colour, 'False colour'),
            ...(data.comparisons.some((c) => c.region) ? [h('label', { class: 'check', title: 'The pixels that the verdict on the highlight is about' }, this.region, 'Outline the highlight')] : []),
            this.measure.element),
          h('div', { class: 'controls', role: 'group', 'aria-label': 'Zoom' },
            button('−', () => this.camera.zoomBy(0.5), { 'aria-label': 'Zoom out' }),
            button('+', () => this.camera.zoomBy(2), { 'aria-label': 'Zoom in' }),
            button('Fit', () => this.camera.fit()),
            button('Highlight', () => this.camera.goHome(), { title: 'Back to the highlight (h)', 'aria-keyshortcuts': 'h' }), button('1 : 1', () => this.camera.zoomTo(1)),
            button('Worst pixel', () => this.goToWorst(), { title: 'Where the two differ most (w)', 'aria-keyshortcuts': 'w' }),
            button('Fullscreen', () => this.fill(), { title: 'The pictures alone (m)', 'aria-keyshortcuts': 'm' })),
          h('div', { class: 'controls', role: 'group', 'aria-label': 'A line across the picture' },
            this.lineButton,
            button('Row', () => this.lineThrough(true), { title: 'The row of the cursor' }),
            button('Column', () => this.lineThrough(false), { title: 'The column of the cursor' }),
            button('None', () => this.change({ line: '' }), { title: 'No line' })),
          this.values.element, this.mapHistogram.element,
          keysHelp(this.choice.oldAgainstNew().length > 0))),
      this.lineBox.element, this.histogram.element);

    this.painter = new PngPainter(this.canvas, data, () => this.schedule(), () => this.isWaiting);
    listenToPointer(this);
    listenToKeys(this);
    link.onChange(() => { this.state.cursor = undefined; this.refresh(); });
    new ResizeObserver(() => this.schedule()).observe(this.stage);
    this.refresh();
  }

  setMode(value: string): void {
    this.change({ mode: value });
    announce(kModes.find((mode) => mode.value === value)?.label ?? '');
  }

  /** The pictures fill the screen, or no longer do. */
  fill(): void {
    const column = this.stage.parentElement;
    if (document.fullscreenElement) void document.exitFullscreen();
    else column?.requestFullscreen().catch(() => this.tell('This browser does not let a page fill the screen.'));
  }

  /** Another picture as the second one. */
  nextPicture(by: 1 | -1): void {
    const all = this.choice.engines(), at = all.indexOf(this.choice.engine('b'));
    const next = this.data.engines[all[(at + by + all.length) % all.length]!]!;
    this.change({ b: next.name });
    announce(next.title);
  }

  exchange(): void {
    const name = (which: 'a' | 'b'): string => this.data.engines[this.choice.engine(which)]!.name;
    this.change({ a: name('b'), b: name('a') });
  }

  /** Of the chosen engine if it has both; after that of the next. */
  showOldAgainstNew(): void {
    const pairs = this.choice.oldAgainstNew(), name = (which: 'a' | 'b'): string => this.data.engines[this.choice.engine(which)]!.name;
    const shown = pairs.findIndex((p) => p.a === name('a') && p.b === name('b'));
    const chosen = pairs.find((p) => p.b === name('b')) ?? pairs.find((p) => p.b === name('a'));
    const next = shown >= 0 ? pairs[(shown + 1) % pairs.length] : chosen ?? pairs[0];
    if (!next) return;
    this.change(next);
    announce(`${this.data.engines.find((e) => e.name === next.b)!.title}, before and now`);
  }

  change(changes: Parameters<LinkState['set']>[0]): void {
    this.link.set(changes);
    this.refresh();
  }

  private refresh(): void {
    const a = this.choice.engine('a'), b = this.choice.engine('b'), mode = this.choice.mode();
    this.pick.a.set(this.data.engines[a]?.name ?? '');
    this.pick.b.set(this.data.engines[b]?.name ?? '');
    this.measure.set(this.choice.mapAsked()?.value ?? this.choice.measure());
    this.measure.element.hidden = mode !== 'diff';
    for (const control of this.modes.querySelectorAll('button'))
      control.setAttribute('aria-pressed', String(control.dataset['mode'] === mode));
    this.divider.hidden = mode !== 'slide';
    this.divider.value = this.link.get('split');
    this.colour.checked = this.link.get('colour') === 'false';
    this.region.checked = this.choice.showsRegion();
    const base = this.choice.baseStops();
    this.exposure.min = String(mode === 'diff' ? -kMostGain : base + kStops.from);
    this.exposure.max = String(mode === 'diff' ? kMostGain : base + kStops.to);
    const chosen = mode === 'diff' ? this.choice.gain() : this.choice.stops();
    this.exposure.value = String(chosen);  // the slider rounds it to its steps
    const stops = numberText(Math.round(100 * chosen) / 100, 5);
    this.exposureName.textContent = mode === 'diff' ? `Gain of the difference ${stops} stops` : `Exposure ${stops} stops`;
    // A finger scrolls the page, unless the picture is enlarged or a line is drawn.
    this.stage.style.touchAction = this.camera.isWhole() && !this.isDrawing ? 'pan-y' : 'none';
    for (const which of [a, b, 0]) void this.pictures.need(which);
    this.schedule();
  }

  private useFloats(): void {
    const ours = this.pictures.all.get(0);
    if (!ours) return;
    if (!this.state.isFloat) {
      this.painter = new FloatPainter(this.canvas, this.pictures.all);
      this.state.isFloat = true;
      this.camera.size = ours;
      this.camera.home = this.pictures.highlight();
    }
    this.stage.dataset['ready'] = String(this.pictures.all.size);
  }

  private tell(words: string): void { this.message.textContent = words; }

  private lacks(engine: number, why?: string): void {
    if (why !== undefined) {
      if (engine === 0) this.isWaiting = false;
      this.tell(why);
      this.schedule();
    } else if (engine === 0 || this.state.isFloat) {
      this.tell('This gallery has no float pictures here: exposure, false colour and values need them.');
    }
  }

  goToWorst(): void {
    const worst = this.state.worstPixel(this.choice.engine('a'), this.choice.engine('b'));
    if (!worst) return;
    this.setCursor(worst.x, worst.y, true);
    if (!this.camera.isWhole()) this.camera.moveTo(worst.x + 0.5, worst.y + 0.5, this.camera.view().zoom / devicePixelRatio);
    announce(`Largest difference at pixel ${worst.x}, ${worst.y}: ${numberText(worst.value)}`);
  }

  private schedule(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => { this.pending = false; this.paint(); });
  }

  /** The panes of the stage, and their width and height together; `times` larger. */
  private panes(times: number): { list: Pane[]; width: number; height: number } {
    const panes = this.camera.rectangles().map((r) => ({ x: r.x * times, y: r.y * times, width: r.width * times, height: r.height * times }));
    const shown = this.camera.view(), view = { ...shown, zoom: shown.zoom * times }, mode = this.choice.mode();
    const a = this.choice.engine('a'), b = this.choice.engine('b'), all = panes[0]!;
    const picture = (engine: number): Content => ({ kind: 'picture', engine });
    const list: Pane[] = [];
    if (mode === 'slide') {
      const left = Math.round(all.width * clamp(this.link.number('split'), 0, 100) / 100);
      list.push({ at: { ...all, width: left }, view, content: picture(a) },
        { at: { ...all, x: left, width: all.width - left }, view: { ...view, x: view.x + left / view.zoom }, content: picture(b) });
    } else if (mode === 'side') {
      list.push({ at: panes[0]!, view, content: picture(a) }, { at: panes[1]!, view, content: picture(b) });
    } else if (mode === 'flip') {
      list.push({ at: all, view, content: picture(this.state.isFlipped() ? b : a) });
    } else {
      const map = this.state.mapOf(a, b), white = this.state.white(a, b);
      list.push({ at: all, view, content: map ? { kind: 'map', picture: map.picture, white } : { kind: 'difference', a, b, measure: this.choice.measure(), white } });
    }
    return { list, width: mode === 'side' ? panes[1]!.x + panes[1]!.width : all.width, height: all.height };
  }

  /** What the stage shows, painted anew as large as a figure is. */
  painted(): { picture: HTMLCanvasElement; overlay: Element[]; overlayWidth: number } {
    const times = enlargement(this.panes(1).width), { list, width, height } = this.panes(times);
    this.painter.paint(width, height, list, this.state.look(this.choice.engine('a'), this.choice.engine('b')));
    const picture = h('canvas', { width, height });
    picture.getContext('2d')?.drawImage(this.canvas, 0, 0);
    this.paint();
    return { picture, overlay: [...this.overlay.children].filter((e) => !e.classList.contains('pixel')), overlayWidth: this.overlay.clientWidth || width };
  }

  private paint(): void {
    const panes = this.camera.rectangles(), view = this.camera.view(), mode = this.choice.mode();
    const a = this.choice.engine('a'), b = this.choice.engine('b'), { list, width, height } = this.panes(1);
    this.painter.paint(width, height, list, this.state.look(a, b));
    this.showTags(mode, a, b, this.state.isFlipped());
    this.legend.replaceChildren(...legendOf(this.state, a, b));
    this.values.show(this.state, a, b);
    const region = this.choice.showsRegion() ? this.choice.comparison(a, b)?.region : undefined;
    this.overlay.replaceChildren(...overlayOf(this.choice, panes, view, this.state.cursorNow(a, b),
      (transform) => (region ? this.outline.drawn(region, transform) : [])));
    this.lineBox.show(this.state, a, b);
    this.histogram.show(this.state, a, b);
    this.mapHistogram.show(this.state, a, b);
  }

  private showTags(mode: string, a: number, b: number, isFlipped: boolean): void {
    const title = (engine: number): string => this.data.engines[engine]?.title ?? '';
    const words = mode === 'diff' ? [`${title(a)} − ${title(b)}`] : mode === 'flip' ? [title(isFlipped ? b : a)] : [title(a), title(b)];
    this.tags.replaceChildren(...words.map((w) => h('span', {}, w)));
    this.tags.className = 'tags ' + mode;
  }

  startLine(): void {
    this.isDrawing = !this.isDrawing;
    if (this.isDrawing) announce('Draw a line across the picture with the pointer.');
    this.lineButton.setAttribute('aria-pressed', String(this.isDrawing));
    this.stage.classList.toggle('drawing', this.isDrawing);
  }

  private lineThrough(isRow: boolean): void {
    const { x, y } = this.state.cursorOrMiddle();
    this.change({ line: isRow ? `0,${y},${this.camera.size.width - 1},${y}` : `${x},0,${x},${this.camera.size.height - 1}` });
  }

  setCursor(x: number, y: number, keep = false): void {
    const cursor = this.state.cursor = this.state.inside(x, y);
    if (keep) this.link.set({ at: `${cursor.x},${cursor.y}` });
    this.schedule();
  }
}

function keysHelp(hasBefore: boolean): HTMLElement {
  const keys: readonly (readonly [string, string])[] = [
    ['1 … 9', 'first picture; with Shift the second'], ['f', 'flip between the two: a click does it too, and a press shows the other while it lasts'], ['t', 'blink: the two in turn, by a timer'], ['l s d', 'divider, side by side, difference'],
    ['x', 'exchange the two'], ...(hasBefore ? [['b', 'old against new'] as const] : []), ['e E', 'brighter, darker'], ['c', 'false colour'], ['+ − 0 h', 'zoom in, out, fit, the highlight'], ['w', 'where the two differ most'], ['p', 'draw a line'],
    ['m', 'fullscreen'], [', .', 'previous, next picture as the second'], ['j k', 'next, previous cell along the last axis'],
  ];
  return h('details', { class: 'keys' }, h('summary', {}, 'Keys'),
    h('dl', {}, ...keys.map(([key, what]) => h('div', {}, h('dt', {}, h('kbd', {}, key)), h('dd', {}, what)))));
}
