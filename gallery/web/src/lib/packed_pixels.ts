// Reads the pictures that gallery/packed/packed_pixels.cpp writes, and shows pixels as a picture's address.

export interface PackedSize { readonly width: number; readonly height: number; readonly way: number }

const kFromNeighbours = 1, kFromFirst = 2, kMostSide = 4096;

export class PackedPixels {
  private readonly starts: number[] = [];
  private readonly total: number;

  /** Throws an error for the reader if the bytes are not those of such pictures. */
  constructor(private readonly sizes: readonly PackedSize[], private readonly bytes: Uint8Array) {
    let total = 0;
    for (const { width, height, way } of sizes) {
      const areSides = [width, height].every((side) => Number.isInteger(side) && side >= 0 && side <= kMostSide);
      const isLikeFirst = width === sizes[0]!.width && height === sizes[0]!.height && sizes[0]!.way < kFromFirst;
      if (!areSides || ![0, 1, 2, 3].includes(way) || (way >= kFromFirst && !isLikeFirst)) throw new Error('no such picture');
      this.starts.push(total);
      total += width * height;
    }
    if (bytes.length !== 3 * total) throw new Error(`${bytes.length} bytes in place of ${3 * total}`);
    this.total = total;
  }

  /** Red, green and blue of each pixel. Empty if there is no picture of this number. */
  rgb(index: number): Uint8Array {
    const size = this.sizes[index];
    if (!size) return new Uint8Array();
    const { width, height, way } = size, pixels = width * height, rgb = new Uint8Array(3 * pixels), plane = new Int8Array(pixels);
    for (const [p, channel] of [1, 0, 2].entries()) {
      this.readPlane(plane, width, p * this.total + this.starts[index]!, (way & kFromNeighbours) !== 0);
      const add = p === 0 && way < kFromFirst ? 128 : 0;
      for (let i = 0; i < pixels; ++i) rgb[3 * i + channel] = plane[i]! + (p === 0 ? add : rgb[3 * i + 1]!);
    }
    if (way >= kFromFirst) { const first = this.rgb(0); for (let i = 0; i < rgb.length; ++i) rgb[i]! += first[i]!; }
    return rgb;
  }

  private readPlane(plane: Int8Array, width: number, at: number, isPredicted: boolean): void {
    for (let i = 0, x = 0; i < plane.length; ++i, x = x + 1 === width ? 0 : x + 1) {
      let guess = 0;
      if (isPredicted) {
        const row0 = i < width, left = x > 0 ? plane[i - 1]! : row0 ? 0 : plane[i - width]!;
        const above = row0 ? left : plane[i - width]!, corner = x === 0 || row0 ? left : plane[i - width - 1]!;
        guess = corner >= Math.max(left, above) ? Math.min(left, above)
          : corner <= Math.min(left, above) ? Math.max(left, above) : left + above - corner;
      }
      const code = this.bytes[at + i]!;
      plane[i] = guess + (code >> 1 ^ -(code & 1));
    }
  }

  /** For an <img>. Empty if there is no picture of this number. */
  address(index: number): string {
    const size = this.sizes[index];
    return size && size.width * size.height > 0 ? bmp(size, this.rgb(index)) : '';
  }
}

/** The policy of the page allows data: pictures, and a BMP is its pixels as they are. */
function bmp({ width, height }: PackedSize, rgb: Uint8Array): string {
  const kHead = 54, row = Math.ceil(3 * width / 4) * 4, file = new Uint8Array(kHead + row * height), head = new DataView(file.buffer);
  head.setUint16(0, 0x424d);  // "BM"
  for (const [at, value] of [[2, file.length], [10, kHead], [14, 40], [18, width], [22, height], [34, row * height]] as const) head.setUint32(at, value, true);
  head.setUint16(26, 1, true);
  head.setUint16(28, 24, true);
  for (let y = 0, from = 0; y < height; ++y)  // from the lowest row
    for (let x = 0, to = kHead + (height - 1 - y) * row; x < width; ++x, from += 3) {
      file[to++] = rgb[from + 2]!;
      file[to++] = rgb[from + 1]!;
      file[to++] = rgb[from]!;
    }
  let text = '';
  for (let at = 0; at < file.length; at += 8192) text += String.fromCharCode(...file.subarray(at, at + 8192));
  return 'data:image/bmp;base64,' + btoa(text);
}
