// Paints float pictures: each once, in its own size; the browser enlarges it.
import { h } from '../lib/dom';
import { clamp } from '../lib/numbers';
import { between, encoded, kColours, stopsOf } from './colours';
import type { FloatPicture } from './half_picture';
import { drawPanes, type Content, type Look, type Painter, type Pane } from './painter';

type Rgb = [number, number, number];
/** Puts the colour of pixel (x, y) into `colour`, each from 0 to 255. */
type Shader = (x: number, y: number, colour: Rgb) => void;

const kSteps = 1 << 14, kRampSteps = 1023;
const kMostKept = 4;  // painted pictures: two, and those that they are flipped with

/** sRGB of linear values from 0 to 1. */
const encodedOf = (): Float32Array => Float32Array.from({ length: kSteps + 1 }, (_, i) => 255 * encoded(i / kSteps));

function rampOf(kind: Content['kind']): Float32Array {
  const stops = stopsOf(kColours[kind]), ramp = new Float32Array(3 * (kRampSteps + 1));
  for (let i = 0; i <= kRampSteps; ++i) ramp.set(between(stops, i / kRampSteps), 3 * i);
  return ramp;
}

function put(colour: Rgb, r: number, g: number, b: number): void {
  colour[0] = r;
  colour[1] = g;
  colour[2] = b;
}

/** Whether both have the same members. */
function isSame(p: object, q: object): boolean {
  const members = Object.entries(p);
  return members.length === Object.keys(q).length && members.every(([key, value]) => (q as Record<string, unknown>)[key] === value);
}

export class FloatPainter implements Painter {
  private readonly encoded = encodedOf();
  private readonly kept: { readonly content: Content; readonly look: Look; readonly image: HTMLCanvasElement }[] = [];

  /** `pictures`: the loaded ones, by the engine's index. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly pictures: ReadonlyMap<number, FloatPicture>) {}

  paint(width: number, height: number, panes: readonly Pane[], look: Look): void {
    const ours = this.pictures.get(0);
    drawPanes(this.canvas, width, height, panes, (context, { at, view, content }) => {
      const image = this.imageOf(content, look);
      if (!ours || !image) return;
      const block = content.kind === 'map' ? content.picture.block : 1;
      context.imageSmoothingEnabled = false;
      context.drawImage(image, 0, 0, ours.width / block, ours.height / block,
        at.x - view.x * view.zoom, at.y - view.y * view.zoom, ours.width * view.zoom, ours.height * view.zoom);
    });
  }

  /** As it was painted before, if it looks the same. */
  private imageOf(content: Content, look: Look): HTMLCanvasElement | undefined {
    const known = this.kept.find((one) => isSame(one.content, content) && isSame(one.look, look));
    if (known) return known.image;
    const shader = this.shaderOf(content, look), size = content.kind === 'map' ? content.picture : this.pictures.get(0);
    if (!shader || !size) return undefined;
    const image = h('canvas', { width: size.width, height: size.height }), data = new ImageData(size.width, size.height), colour: Rgb = [0, 0, 0];
    for (let y = 0, at = 0; y < size.height; ++y)
      for (let x = 0; x < size.width; ++x, at += 4) {
        shader(x, y, colour);
        data.data.set(colour, at);
        data.data[at + 3] = 255;
      }
    image.getContext('2d')?.putImageData(data, 0, 0);
    this.kept.unshift({ content, look, image });
    this.kept.length = Math.min(this.kept.length, kMostKept);
    return image;
  }

  private shaderOf(content: Content, look: Look): Shader | undefined {
    const ours = this.pictures.get(0), ramp = rampOf(content.kind);
    const ramped = (share: number, colour: Rgb): void => {
      const at = 3 * Math.round(kRampSteps * clamp(share, 0, 1));
      put(colour, ramp[at]!, ramp[at + 1]!, ramp[at + 2]!);
    };
    const coloured = (value: number, colour: Rgb): void =>
      ramped(1 + Math.log10(Math.max(value, 1e-37) / look.top) / look.decades, colour);
    if (content.kind === 'map') {
      const { picture, white } = content;
      return (x, y, colour) => {
        const value = picture.values[3 * (y * picture.width + x)]!;
        if (!Number.isFinite(value)) put(colour, 255, 0, 255);
        else if (look.falseColour) coloured(value, colour);
        else ramped(value / white, colour);
      };
    }
    const a = this.pictures.get(content.kind === 'picture' ? content.engine : content.a);
    const b = content.kind === 'picture' ? a : this.pictures.get(content.b);
    if (!ours || !a || !b) return undefined;
    const valueOf = (p: FloatPicture, at: number): number => p.values[at]! + (p.fromOurs ? ours.values[at]! : 0);
    if (content.kind === 'picture') {
      const gain = 2 ** look.stops, shown = (value: number): number => this.encoded[Math.round(kSteps * clamp(value * gain, 0, 1))]!;
      return (x, y, colour) => {
        const at = 3 * (y * a.width + x), red = valueOf(a, at), green = valueOf(a, at + 1), blue = valueOf(a, at + 2);
        if (!Number.isFinite(red + green + blue)) put(colour, 255, 0, 255);
        else if (look.falseColour) coloured((red + green + blue) / 3, colour);
        else put(colour, shown(red), shown(green), shown(blue));
      };
    }
    const { measure, white } = content, sharesOurs = a.fromOurs === b.fromOurs;
    const difference = (at: number): number => {
      // Subtracting two stored differences from ours keeps digits that the values have lost.
      const d = sharesOurs ? a.values[at]! - b.values[at]! : valueOf(a, at) - valueOf(b, at);
      return measure !== 'relative' || d === 0 ? d : d / Math.max(Math.abs(valueOf(b, at)), 1e-37);
    };
    return (x, y, colour) => {
      const at = 3 * (y * a.width + x), red = difference(at) / white, green = difference(at + 1) / white, blue = difference(at + 2) / white;
      if (!Number.isFinite(red + green + blue)) return put(colour, 255, 0, 255);
      if (measure === 'signed') {
        const mean = (red + green + blue) / 3, strength = Math.sqrt(Math.min(1, Math.abs(mean)));
        const mixed = (end: number): number => 255 * (0.06 + (end - 0.06) * strength);
        return mean > 0 ? put(colour, mixed(1), mixed(0.45), mixed(0.2)) : put(colour, mixed(0.3), mixed(0.65), mixed(1));
      }
      const [r, g, bl] = [Math.abs(red), Math.abs(green), Math.abs(blue)];
      if (look.falseColour) coloured(Math.max(r, g, bl) * look.top, colour);
      else put(colour, 255 * r, 255 * g, 255 * bl);
    };
  }
}
