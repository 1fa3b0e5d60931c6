// Maps of visible differences, which the program made of the pairs that it compared.
import type { Worst } from './float_pictures';
import { loadFloatPicture, type FloatPicture } from './half_picture';
import type { ShownMap } from '../records';

export interface LoadedMap extends ShownMap {
  readonly picture: FloatPicture;
  readonly worst: Worst;
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

  /** Undefined until it is loaded; the first call starts that. */
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
