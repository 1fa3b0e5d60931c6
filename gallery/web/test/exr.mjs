// Reads back what Lobelia writes: EXR of 32-bit floats by rows, packed by ZIP.
import { readFileSync } from 'node:fs';
import { inflateSync } from 'node:zlib';

/** Red, from the bottom row up. */
export function redOf(file) {
  const bytes = readFileSync(file), header = {};
  let at = 8;
  const word = () => { const end = bytes.indexOf(0, at), text = bytes.toString('latin1', at, end); at = end + 1; return text; };
  for (let name = word(); name; name = word()) {
    word();  // its type
    const size = bytes.readInt32LE(at);
    header[name] = bytes.subarray(at + 4, at += 4 + size);
  }
  const [left, top, right, bottom] = [0, 4, 8, 12].map((i) => header.dataWindow.readInt32LE(i));
  const width = right - left + 1, height = bottom - top + 1, rows = { 2: 1, 3: 16 }[header.compression[0]], channels = 3;
  const red = new Float32Array(width * height);
  for (let first = 0; first < height; first += rows) {
    const chunk = Number(bytes.readBigUInt64LE(at + 8 * first / rows)), size = bytes.readInt32LE(chunk + 4);
    const whole = 4 * channels * width * Math.min(rows, height - first), packed = bytes.subarray(chunk + 8, chunk + 8 + size);
    let data = packed;
    if (size < whole) {
      // Each byte is stored as its difference from the one before, the even ones before the odd ones.
      const differences = inflateSync(packed);
      for (let i = 1; i < whole; ++i) differences[i] += differences[i - 1] - 128;
      data = Buffer.alloc(whole);
      for (let i = 0; i < whole; ++i) data[i] = differences[(i >> 1) + (i & 1 ? (whole + 1) >> 1 : 0)];
    }
    for (let y = first; y < Math.min(height, first + rows); ++y)
      for (let x = 0; x < width; ++x)  // B, G, R
        red[(height - 1 - y) * width + x] = data.readFloatLE(4 * (((y - first) * channels + 2) * width + x));
  }
  return red;
}
