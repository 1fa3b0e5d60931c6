// Where two pictures look different, by a metric: made by the program, of pairs that it compared.
import { loadFloatPicture, type FloatPicture } from './half_picture';
import type { ShownMap } from '../records';

export interface LoadedMap extends ShownMap {
  readonly picture: FloatPicture;
  readonly worst: { readonly value: number; readonly x: number; readonly y: number };
}

/** The first channel; all three are the same. */
export function valueOfMap(map: LoadedMap, x: number, y: number): number | undefined {
  const { width, height, values, block } = map.picture, column = Math.floor(x / block), row = Math.floor(y / block);
  return column < 0 || row < 0 || column >= width || row >= height ? undefined : values[3 * (row * width + column)];
}

function withWorst(map: ShownMap, picture: FloatPicture): LoadedMap {
  let value = 0, at = 0;
  for (let i = 0; i < picture.values.length; i += 3) {
    const one = picture.values[i]!;
    if (one > value && Number.isFinite(one)) { value = one; at = i / 3; }
  }
  return { ...map, picture, worst: { value, x: picture.block * (at % picture.width), y: picture.block * Math.floor(at / picture.width) } };
}

export class DifferenceMaps {
  private readonly loaded = new Map<string, LoadedMap>();
  private readonly asked = new Set<string>();

  constructor(private readonly repaint: () => void, private readonly tell: (words: string) => void) {}

  /** Undefined until it is there; the first time it is asked for it is on its way. */
  of(map: ShownMap): LoadedMap | undefined {
    if (!this.asked.has(map.script)) {
      this.asked.add(map.script);
      loadFloatPicture(map.script).then((picture) => {
        this.loaded.set(map.script, withWorst(map, picture));
        this.repaint();
      }, (error: unknown) => this.tell(error instanceof Error ? error.message : String(error)));
    }
    return this.loaded.get(map.script);
  }
}
