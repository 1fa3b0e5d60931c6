// Paints the sphere without WebGL 2, from the tables, which are good to 1e-3 of the peak.
import { cameraOf, kDistance, type SpherePainter, type Surface, type Vector } from './sphere';

const kSteps = 4096;

/** The lobe in even steps of the root of s, in which it is smooth at the peak. */
function lobeOf({ curve }: Surface): (s: number) => number {
  const { x, y } = curve, values = new Float64Array(kSteps + 2);
  for (let i = 0, j = 0; i <= kSteps; ++i) {
    const angle = Math.acos(1 - (i / kSteps) ** 2) * 180 / Math.PI;
    while (j < x.length - 2 && x[j + 1]! < angle) ++j;
    const share = (angle - x[j]!) / (x[j + 1]! - x[j]!);
    values[i] = share > 1 ? 0 : y[j]! + share * (y[j + 1]! - y[j]!);
  }
  return (s) => {
    if (s >= 1) return 0;
    const at = Math.sqrt(s) * kSteps, i = Math.floor(at);
    return values[i]! + (at - i) * (values[i + 1]! - values[i]!);
  };
}

/** Smith's G / (N.V) for GGX of the same sharpness (renderer/models/microfacet_smith.hpp). */
function shadowing(n: number, light: number, eye: number): number {
  const a = 2 / (n + 2), root = (c: number): number => Math.sqrt(a + (1 - a) * c * c);
  return 2 * light / (light * root(eye) + eye * root(light));
}

function radianceOf(surface: Surface): (normal: Vector, toEye: Vector, toLight: Vector) => number {
  const lobe = lobeOf(surface), { model, n, coefficient } = surface, isMirror = model.angle === 'L and R';
  return (normal, eye, light) => {
    const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const cosine = dot(normal, light), toEye = dot(normal, eye);
    if (cosine <= 0) return 0;
    const length = Math.sqrt(2 + 2 * dot(light, eye));
    const s = isMirror ? 1 - (2 * toEye * cosine - dot(eye, light)) : 1 - (cosine + toEye) / Math.max(length, 1e-6);
    return coefficient * lobe(Math.max(0, s)) * (model.hasShadowing ? shadowing(n, cosine, toEye) : model.appliesCosine ? cosine : 1);
  };
}

export class CpuSphere implements SpherePainter {
  paint(size: number, toLight: Vector, surfaces: readonly Surface[]): Float32Array {
    const pixels = new Float32Array(4 * size * size), { scale, edge } = cameraOf(size), shade = surfaces.map(radianceOf);
    for (let p = 0; p < size * size; ++p) {
      const x = 2 * (p % size) + 1 - size, y = 2 * Math.floor(p / size) + 1 - size, squares = x * x + y * y;
      if (squares > edge) continue;
      const q = scale * scale * squares, z = (kDistance * q + scale * Math.sqrt((kDistance ** 2 - 1) * (edge - squares))) / (1 + q);
      const normal: Vector = [(kDistance - z) * scale * x, (kDistance - z) * scale * y, z], length = Math.sqrt(1 + q);
      shade.forEach((radiance, i) => { pixels[4 * p + i] = radiance(normal, [-scale * x / length, -scale * y / length, 1 / length], toLight); });
      pixels[4 * p + 3] = 1;
    }
    return pixels;
  }
}
