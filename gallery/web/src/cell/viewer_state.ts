// The state of a cell's viewer: the reader's choice, the pictures and maps that are loaded, and the cursor.
import { clamp, toNumber } from '../lib/numbers';
import type { CellPage } from '../records';
import type { Camera } from './camera';
import type { Choice } from './choice';
import type { FloatPictures, Worst } from './float_pictures';
import type { DifferenceMaps, LoadedMap } from './maps';
import type { Look } from './painter';

export const kDecades = 6;  // of false colour

/** `a` and `b` are the chosen engines, by their index in the data. */
export class ViewerState {
  readonly data: CellPage;
  /** Float pictures are painted. */
  isFloat = false;
  /** Under the pointer. */
  cursor: { x: number; y: number } | undefined;

  constructor(readonly choice: Choice, readonly camera: Camera, readonly pictures: FloatPictures,
              private readonly maps: DifferenceMaps) {
    this.data = choice.data;
  }

  /** The map that is asked for, if these two have it and it is loaded. */
  mapOf(a: number, b: number): LoadedMap | undefined {
    const asked = this.choice.mode() === 'diff' && this.isFloat ? this.choice.mapAsked() : undefined;
    const map = asked && this.choice.comparison(a, b)?.maps.find((m) => m.id === asked.value);
    return map && this.maps.of(map);
  }

  /** As recorded, from all bits; for two that were not compared, from this page's pictures. */
  worstPixel(a: number, b: number): Worst | undefined {
    const map = this.mapOf(a, b);
    if (map) return map.worst;
    if (this.choice.mode() === 'diff' && this.choice.measure() === 'relative') return this.pictures.worst(a, b, 'relative');
    const found = this.pictures.worst(a, b, 'absolute'), record = this.choice.comparison(a, b);
    const x = toNumber(record?.worstX), y = toNumber(record?.worstY);
    return found && Number.isInteger(x) && Number.isInteger(y) ? { ...found, ...this.inside(x, y) } : found;
  }

  /** The difference that is white. */
  white(a: number, b: number): number {
    const map = this.mapOf(a, b);
    // A scale of its own: a colour means the same on every page, and differences too small to notice stay dark.
    if (map) return map.top / 2 ** this.choice.gain();
    const measure = this.choice.measure(), whiteAt = toNumber(this.choice.comparison(a, b)?.whiteAt);
    const base = measure !== 'relative' && whiteAt > 0 ? whiteAt : this.isFloat ? this.pictures.largestOf(a, b, measure) : 1;
    return base / 2 ** this.choice.gain();
  }

  isFalseColour(): boolean { return this.isFloat && this.choice.state.get('colour') === 'false'; }

  look(a: number, b: number): Look {
    const isDifference = this.choice.mode() === 'diff';
    return {
      stops: this.choice.stops(), falseColour: this.isFalseColour(), decades: kDecades,
      top: !this.isFloat ? 1 : isDifference ? this.white(a, b) : this.pictures.largestOf(0, 0, 'value') * 2 ** (this.choice.baseStops() - this.choice.stops()),
    };
  }

  isFlipped(): boolean { return this.choice.mode() === 'flip' && this.choice.state.get('shown') === 'b'; }

  /** Under the pointer; else from the link; else where the two differ most. */
  cursorNow(a: number, b: number): { x: number; y: number } | undefined {
    const [x = NaN, y = NaN] = this.choice.state.get('at').split(',').map(Number);
    const linked = Number.isInteger(x) && Number.isInteger(y) && x >= 0 && y >= 0 && x < this.camera.size.width && y < this.camera.size.height;
    return this.cursor ?? (linked ? { x, y } : this.isFloat ? this.worstPixel(a, b) : undefined);
  }

  cursorOrMiddle(): { x: number; y: number } {
    const { width, height } = this.camera.size;
    return this.cursorNow(this.choice.engine('a'), this.choice.engine('b')) ?? { x: Math.floor(width / 2), y: Math.floor(height / 2) };
  }

  /** The pixel of the picture that is nearest to these. */
  inside(x: number, y: number): { x: number; y: number } {
    return { x: clamp(Math.floor(x), 0, this.camera.size.width - 1), y: clamp(Math.floor(y), 0, this.camera.size.height - 1) };
  }
}
