// The sphere with one highlight or two: the divider between them or their difference, the light and the camera by
// pointer and keys, and what the float pixels say.
import { encoded } from '../cell/colours';
import { announce, button, h, select } from '../lib/dom';
import { figureButton, type FigureSource } from '../lib/figure';
import { fileName } from '../lib/figure_text';
import { clamp, numberText } from '../lib/numbers';
import type { HashState } from '../lib/state';
import { GlSphere } from './gl_sphere';
import { seenFrom, type Surface, type Vector, vectorAt } from './sphere';

export const kSphereState = { light: '-40,30', camera: '0,0', wipe: '36.5', ev: '0', show: 'wipe', px: '512' };
type Key = keyof typeof kSphereState;

/** Another source of B's radiances than an exported shader, by pixels from the bottom row. */
export interface Second { readonly isShown: boolean; readonly isStuck: boolean; sphere(size: number, toLight: Vector): Promise<Float32Array | undefined> }
type Turned = 'light' | 'camera';

const kSizes = ['256', '512', '1024'], kMostStops = 12;
const kMostOwn = 512;  // pixels of a reader's shader, each of which is a point in the search's memory
const kSteps = 4095;
/** As the canvas has it in a number of 32 bits. */
const pixelOf = (red: number, green: number, blue: number): number => (255 << 24 | blue << 16 | green << 8 | red) >>> 0;
const colours = (of: (share: number) => number): Uint32Array => Uint32Array.from({ length: kSteps + 1 }, (_, i) => of(i / kSteps));
const kGround = pixelOf(33, 33, 36);
const kGrey = colours((v) => {
  const grey = Math.round(255 * encoded(v));
  return pixelOf(grey, grey, grey);
});
const kLarger = colours((v) => pixelOf(255 * v ** 0.5, 115 * v ** 0.5, 51 * v ** 0.5));
const kSmaller = colours((v) => pixelOf(77 * v ** 0.5, 166 * v ** 0.5, 255 * v ** 0.5));

export class SphereView {
  private readonly canvas = h('canvas', { 'aria-hidden': 'true' });
  private readonly tags = h('div', { class: 'tags', 'aria-hidden': 'true' });
  private readonly stage = h('div', {
    class: 'sphere-stage', tabindex: 0, role: 'application', 'aria-roledescription': 'lit sphere', 'aria-describedby': 'sphere-numbers',
    'aria-label': 'The sphere. Arrow keys turn the light, with Shift the camera.',
  }, this.canvas, this.tags);
  private readonly wipe = h('input', { type: 'range', min: 0, max: 100, step: 0.5, class: 'divider', 'aria-label': 'Divider between A and B' });
  private readonly ev = h('input', { type: 'range', min: -kMostStops, max: kMostStops, step: 0.5, id: 'sphere-ev' });
  private readonly evName = h('label', { for: 'sphere-ev' });
  private readonly numbers = h('p', { class: 'sphere-numbers', id: 'sphere-numbers' });
  private readonly note = h('p', { class: 'stage-note', role: 'status' });
  private readonly drag;
  private readonly show;
  private readonly px;
  private turned: Turned = 'light';
  private angles: Record<Turned, number[]> = { light: [0, 0], camera: [0, 0] };
  private painter: GlSphere | undefined;
  private surfaces: readonly Surface[] = [];
  private pixels: Float32Array | undefined;
  private size = 0;
  private pending = false;
  private waiting = false;
  private again = false;
  readonly element: HTMLElement;

  /** `about` names the highlights that are shown, A first. */
  constructor(private readonly state: HashState<Key>, private readonly about: () => readonly string[], private readonly second: Second) {
    const change = (changes: Partial<Record<Key, string>>): void => { state.set(changes); this.refresh(this.surfaces); };
    this.drag = select('Drag turns', [{ value: 'light', label: 'the light' }, { value: 'camera', label: 'the camera' }], 'light',
      (v) => { this.turned = v as Turned; }, 'sphere-drag');
    this.show = select('Show', [{ value: 'wipe', label: 'A beside B' }, { value: 'difference', label: 'A − B' }], 'wipe', (show) => change({ show }), 'sphere-show');
    this.px = select('Pixels', kSizes.map((v) => ({ value: v, label: `${v} × ${v}` })), '512', (px) => change({ px }), 'sphere-px');
    this.wipe.addEventListener('input', () => change({ wipe: this.wipe.value }));
    this.ev.addEventListener('input', () => change({ ev: this.ev.value }));
    this.listen();
    this.element = h('figure', { class: 'chart-figure sphere' }, h('h2', {}, 'The sphere'),
      h('div', { class: 'controls' }, this.drag.element, this.show.element, this.px.element,
        figureButton('the sphere', () => this.figure()),
        button('Reset', () => { change({ ...kSphereState, px: state.get('px') }); announce('Light, camera, divider and exposure are as at first.'); })),
      this.stage, this.wipe, h('div', { class: 'controls exposure' }, this.evName, this.ev), this.numbers, this.note,
      h('figcaption', {}, 'Runs the GLSL that “lobelia export” writes, given below, under a directional light of irradiance 1. White is the larger coefficient.'));
  }

  /** Reads the state again. */
  refresh(surfaces: readonly Surface[]): void {
    this.surfaces = surfaces;
    for (const what of ['light', 'camera'] as const) {
      const read = this.state.get(what).split(',').map(Number), isGood = read.length === 2 && read.every(Number.isFinite);
      this.turn(what, isGood ? read : kSphereState[what].split(',').map(Number));
    }
    const both = this.both();
    this.show.set(this.isDifference() ? 'difference' : 'wipe');
    this.show.element.hidden = !both;
    this.wipe.value = this.state.get('wipe');
    this.wipe.disabled = !both || this.isDifference();
    this.px.set(String(this.pixelCount()));
    this.ev.value = String(this.stops());
    this.evName.textContent = `Exposure ${numberText(this.stops())} stops`;
    this.ev.setAttribute('aria-valuetext', `${this.stops()} stops`);
    this.schedule();
  }

  /** The last picture of a surface as a grey PFM, whose rows begin at the bottom as ours do; undefined without one. */
  pfm(index: number): Blob | undefined {
    this.paint();
    const { size, pixels } = this;
    if (!pixels) return undefined;
    const head = new TextEncoder().encode(`Pf\n${size} ${size}\n-1.0\n`);
    const values = new DataView(new ArrayBuffer(4 * size * size));
    for (let i = 0; i < size * size; ++i) values.setFloat32(4 * i, pixels[4 * i + index]!, true);
    return new Blob([head, values]);
  }

  private figure(): FigureSource {
    this.paint();
    if (!this.pixels) throw new Error('There is no picture.');
    const { size, pixels, canvas } = this, names = this.about(), isDifference = this.isDifference(), both = this.both();
    const top = Math.max(...this.surfaces.map((s) => s.coefficient)) / 2 ** this.stops(), kTicks = [0, 0.25, 0.5, 0.75, 1];
    const css = (colours: Uint32Array, share: number): string => {
      const colour = colours[Math.round(kSteps * share)]!;
      return `rgb(${colour & 255} ${colour >> 8 & 255} ${colour >> 16 & 255})`;
    };
    const picture = h('canvas', { width: size, height: size });
    picture.getContext('2d')!.drawImage(canvas, 0, 0);
    return {
      name: fileName('sphere', ...names, isDifference ? 'difference' : ''),
      title: isDifference ? 'A − B on the sphere' : 'The sphere',
      caption: `${names.map((name, i) => `${this.names()[i]}: ${name}`).join('; ')}. ${this.numbers.textContent} Exposure ${numberText(this.stops())} stops.`,
      csv: {
        what: `radiance at ${size} × ${size} pixels`,
        rows: function* () {
          yield both ? ['x', 'y', 'A', 'B'] : ['x', 'y', 'A'];
          for (let y = 0; y < size; ++y) for (let x = 0; x < size; ++x) {
            const at = 4 * ((size - 1 - y) * size + x);
            if (pixels && pixels[at + 3] !== 0) yield both ? [x, y, pixels[at]!, pixels[at + 1]!] : [x, y, pixels[at]!];
          }
        },
      },
      content: {
        picture, tags: [...this.tags.children].map((tag) => tag.textContent ?? ''),
        bar: isDifference
          ? { label: 'A − B, radiance per unit irradiance', colour: (share) => (share < 0.5 ? css(kSmaller, 1 - 2 * share) : css(kLarger, 2 * share - 1)),
            ticks: kTicks.map((share) => ({ share, label: numberText((2 * share - 1) * top) })) }
          : { label: 'radiance per unit irradiance, shown as sRGB', colour: (share) => css(kGrey, share), ticks: kTicks.map((share) => ({ share, label: numberText(share * top) })) },
      },
    };
  }

  private both(): boolean { return this.surfaces.length > 1 || this.second.isShown; }
  private names(): readonly string[] { return ['A', this.second.isShown ? 'yours' : 'B']; }
  private isDifference(): boolean { return this.both() && this.state.get('show') === 'difference'; }
  private stops(): number { return clamp(this.state.number('ev'), -kMostStops, kMostStops); }
  private split(): number { return this.both() ? clamp(this.state.number('wipe'), 0, 100) / 100 : 1; }
  private pixelCount(): number {
    const asked = Number(kSizes.includes(this.state.get('px')) ? this.state.get('px') : kSphereState.px);
    return this.second.isShown ? Math.min(asked, kMostOwn) : asked;
  }

  /** Without WebGL 2 there is no sphere. */
  private attempt(act: () => void): void {
    try {
      act();
      this.note.textContent = '';
    } catch (error) {
      this.painter = undefined;
      this.note.textContent = `There is no picture, because the shader does not run here: ${error instanceof Error ? error.message : ''}. Curves and numbers need no shader.`;
    }
  }

  private turn(what: Turned, [right, up]: readonly number[]): void {
    this.angles[what] = [((right! + 180) % 360 + 360) % 360 - 180, clamp(up!, -89, 89)];
    this.schedule();
  }
  private turnBy(what: Turned, right: number, up: number): void {
    const [x, y] = this.angles[what];
    this.turn(what, [x! + right, y! + up]);
  }
  /** Only at the end of a drag, because browsers limit changes of the address. */
  private keep(): void {
    const text = (what: Turned): string => this.angles[what].map((v) => String(Number(v.toFixed(2)))).join(',');
    this.state.set({ light: text('light'), camera: text('camera') });
  }

  private listen(): void {
    const { stage } = this;
    let held: { x: number; y: number; what: Turned | 'wipe' } | undefined;
    stage.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || !event.isPrimary) return;
      const box = stage.getBoundingClientRect(), away = Math.abs(event.clientX - box.left - box.width * this.split());
      const isDivider = away < 10 && this.both() && !this.isDifference();
      const other = this.turned === 'light' ? 'camera' : 'light';
      held = { x: event.clientX, y: event.clientY, what: isDivider ? 'wipe' : event.shiftKey ? other : this.turned };
      stage.setPointerCapture(event.pointerId);
    });
    stage.addEventListener('pointermove', (event) => {
      if (!held || !event.isPrimary) return;
      const box = stage.getBoundingClientRect(), degrees = 180 / box.width;
      const right = (event.clientX - held.x) * degrees, down = (event.clientY - held.y) * degrees;
      if (held.what === 'light') this.turnBy('light', right, -down);
      else if (held.what === 'camera') this.turnBy('camera', -right, down);
      else {
        this.wipe.value = String(100 * (event.clientX - box.left) / box.width);
        this.wipe.dispatchEvent(new Event('input'));
      }
      held = { ...held, x: event.clientX, y: event.clientY };
    });
    for (const end of ['pointerup', 'pointercancel'] as const)
      stage.addEventListener(end, () => { if (held) this.keep(); held = undefined; });
    stage.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      const what = event.shiftKey === (this.turned === 'light') ? 'camera' : 'light';
      this.turnBy(what, 5 * step[0]!, 5 * step[1]!);
      this.keep();
      announce(this.where(what));
    });
  }

  private where(what: Turned): string {
    const [right, up] = this.angles[what];
    return `${what === 'light' ? 'Light' : 'Camera'} ${numberText(Math.abs(right!))}° ${right! < 0 ? 'left' : 'right'}, ${numberText(Math.abs(up!))}° ${up! < 0 ? 'down' : 'up'}`;
  }

  private schedule(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => { this.pending = false; this.paint(); });
  }

  private paint(): void {
    if (!this.surfaces.length || this.second.isStuck) return;
    const light = seenFrom(this.angles.camera, vectorAt(this.angles.light)), size = this.pixelCount();
    const own = this.second.isShown;
    this.attempt(() => {
      // A browser may take one from a page whose other shader did not end.
      this.painter ??= new GlSphere();
      this.pixels = this.painter.paint(size, light, own ? this.surfaces.slice(0, 1) : this.surfaces);
    });
    this.size = size;
    if (!this.pixels || !this.painter) return;
    if (own) void this.paintSecond(size, light, this.pixels);
    else this.draw(this.pixels);
  }

  /** The last direction alone, if the light is dragged faster than the shader runs. */
  private async paintSecond(size: number, light: Vector, pixels: Float32Array): Promise<void> {
    this.again = this.waiting;
    if (this.waiting) return;
    this.waiting = true;
    const values = await this.second.sphere(size, light);
    this.waiting = false;
    if (this.again) this.schedule();
    if (!values || size !== this.size) return;
    for (let i = 0; i < values.length; ++i) pixels[4 * i + 1] = values[i]!;
    this.draw(pixels);
  }

  private draw(pixels: Float32Array): void {
    const { size, canvas } = this, both = this.both(), [nameA, nameB] = this.names(), isDifference = this.isDifference();
    if (canvas.width !== size) canvas.width = canvas.height = size;
    const context = canvas.getContext('2d')!, image = context.createImageData(size, size), shown = new Uint32Array(image.data.buffer);
    const gain = kSteps * 2 ** this.stops() / Math.max(...this.surfaces.map((s) => s.coefficient)), split = this.split() * size;
    const step = (v: number): number => clamp(Math.round(v * gain), 0, kSteps) || 0;
    const most = [0, 0];
    let largest = 0, place = 0;
    for (let y = 0, i = 0; y < size; ++y) for (let x = 0; x < size; ++x, ++i) {
      const a = pixels[4 * i]!, b = pixels[4 * i + 1]!, difference = both ? a - b : 0;
      if (Math.abs(difference) > Math.abs(largest)) { largest = difference; place = i; }
      if (a > most[0]!) most[0] = a;
      if (b > most[1]!) most[1] = b;
      shown[(size - 1 - y) * size + x] = pixels[4 * i + 3] === 0 ? kGround
        : isDifference ? (difference > 0 ? kLarger : kSmaller)[step(Math.abs(difference))]! : kGrey[step(x < split ? a : b)]!;
    }
    context.putImageData(image, 0, 0);
    if (both && !isDifference) {
      context.fillStyle = '#fff';
      context.fillRect(split - size / 512, 0, size / 256, size);
    }
    const words = isDifference ? [`orange: ${nameA} is larger`, `blue: ${nameB} is larger`] : this.names().slice(0, both ? 2 : 1);
    this.tags.replaceChildren(...words.map((word) => h('span', {}, word)));
    const brightest = most.slice(0, both ? 2 : 1).map((v, i) => `${this.names()[i]} ${numberText(v, 4)}`).join(', ');
    const peak = Math.max(...most), down = size - 1 - Math.floor(place / size);
    this.numbers.textContent = `${this.where('light')}. ${this.where('camera')}. Brightest pixel: ${brightest}.` + (both
      ? ` Largest difference ${nameA} − ${nameB}: ${numberText(largest)}${peak > 0 ? `, ${numberText(100 * Math.abs(largest) / peak)} % of the brighter` : ''}, at pixel (${place % size}, ${down}).` : '');
  }
}
