// Paints the explorer's sphere: a unit sphere before a camera of 28 degrees, 5 units away, under a directional
// light of irradiance 1, as in reference_scenes/scenes. Vectors are the camera's: x right, y up, z towards the eye.
import type { ModelTable } from '../records';

export type Vector = readonly [number, number, number];

export interface Surface {
  readonly model: ModelTable;
  readonly n: number;
  /** As `lobelia export` writes it; empty in records of older programs. */
  readonly shader: string;
  readonly coefficient: number;
}

export const kDistance = 5;
const kHalfView = Math.tan(14 * Math.PI / 180);

/** A pixel is at (x, y) = `scale` times two odd numbers, at depth 1. It sees the sphere where their squares are at most `edge`. */
export function cameraOf(size: number): { scale: number; edge: number } {
  const scale = kHalfView / size;
  return { scale, edge: 1 / ((kDistance ** 2 - 1) * scale ** 2) };
}

/** The unit vector at degrees to the right of and above the z axis. */
export function vectorAt([right, up]: readonly number[]): Vector {
  const a = right! * Math.PI / 180, b = up! * Math.PI / 180;
  return [Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b)];
}

/** `v` as the camera at these degrees sees it. */
export function seenFrom(camera: readonly number[], v: Vector): Vector {
  const z = vectorAt(camera), x = vectorAt([camera[0]! + 90, 0]), y = vectorAt([camera[0]!, camera[1]! + 90]);
  return [x, y, z].map((axis) => axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2]) as unknown as Vector;
}
