// Reads the pictures that gallery/packed/half_picture.cpp and float_pictures.cpp write.
import { load } from '../lib/data';
import { inflated } from '../lib/inflate';
import type { PackedPicture } from '../records';

export interface FloatPicture extends Omit<PackedPicture, 'planes' | 'predicted'> {
  /** Three values a pixel, row 0 on top; with `fromOurs` their difference from ours. */
  readonly values: Float32Array;
}

/** The values of all half floats from +0 on, by their bits. */
function halfValues(scaleLog2: number): Float64Array {
  const table = new Float64Array(0x8000);
  for (let bits = 0; bits < 0x8000; ++bits) {
    const exponent = bits >> 10, mantissa = bits & 0x3ff;
    const value = exponent === 0 ? mantissa * 2 ** -24 : (1024 + mantissa) * 2 ** (exponent - 25);
    table[bits] = bits > 0x7c00 ? NaN : bits === 0x7c00 ? Infinity : value * 2 ** -scaleLog2;
  }
  return table;
}

function unpacked(bytes: Uint8Array, packed: PackedPicture): Float32Array {
  const { width, height } = packed, pixels = width * height;
  const values = new Float32Array(3 * pixels);
  const table = halfValues(packed.scaleLog2), shift = 10 - packed.mantissaBits;
  const plane = new Int16Array(pixels), sum = new Int16Array(pixels);
  for (let channel = 0; channel < 3; ++channel) {
    const low = 2 * pixels * channel, high = low + pixels;
    for (let i = 0, x = 0; i < pixels; ++i, x = x + 1 === width ? 0 : x + 1) {
      let guess = 0;
      if (packed.predicted) {
        const row0 = i < width;
        const left = x > 0 ? plane[i - 1]! : row0 ? 0 : plane[i - width]!;
        const above = row0 ? left : plane[i - width]!;
        const corner = x === 0 || row0 ? left : plane[i - width - 1]!;
        guess = corner >= Math.max(left, above) ? Math.min(left, above)
          : corner <= Math.min(left, above) ? Math.max(left, above) : left + above - corner;
      }
      const code = bytes[low + i]! | bytes[high + i]! << 8;
      plane[i] = guess + (code >> 1 ^ -(code & 1));
      const number = sum[i] = sum[i]! + plane[i]!;
      const value = table[Math.abs(number) << shift & 0x7fff]!;
      values[3 * i + channel] = number < 0 ? -value : value;
    }
  }
  return values;
}

/** The largest rounding error of a stored value. */
export function roundingAt(picture: FloatPicture, value: number): number {
  const size = Math.abs(value) * 2 ** picture.scaleLog2;
  const exponent = size >= 2 ** -14 ? Math.floor(Math.log2(size)) : -14;  // below, steps are all the same
  return Math.max(2 ** (exponent - picture.mantissaBits - 1 - picture.scaleLog2), picture.least);
}

let before: Promise<unknown> = Promise.resolve();

/** One after the other, because all scripts use one name. Throws an error for the reader. */
export function loadFloatPicture(source: string): Promise<FloatPicture> {
  const picture = before.then(async () => {
    const packed = await load<PackedPicture>('float picture', source);
    const bytes = await inflated(packed.planes);
    if (bytes.length !== 6 * packed.width * packed.height) throw new Error(source + ' is damaged');
    return { ...packed, values: unpacked(bytes, packed) };
  });
  before = picture.catch(() => undefined);
  return picture;
}
