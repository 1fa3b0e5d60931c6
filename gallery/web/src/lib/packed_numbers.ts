// Reads the numbers that gallery/packed/packed_numbers.cpp writes.

const kNan = 2 ** 27, kLeastExponent = -330, kDigits = 5, kDigitsOfDifference = 3;

export class PackedNumbers {
  private readonly count: number;
  private at = 0;

  constructor(private readonly bytes: Uint8Array) {
    if (bytes.length % 4 !== 0) throw new Error(`${bytes.length} bytes are no numbers`);
    this.count = bytes.length / 4;
  }

  skip(count: number): void { this.at += count; }

  /** The next numbers. Those of a curve are steps from value to value, those of a difference are not. */
  next(count: number, isDifference: boolean): number[] {
    if (!(this.at + count <= this.count)) throw new Error('numbers are missing');
    const values: number[] = [];
    for (let before = 0, end = this.at + count; this.at < end; ++this.at) {
      let code = 0;
      for (let byte = 3; byte >= 0; --byte) code = (code << 8 | this.bytes[byte * this.count + this.at]!) >>> 0;
      const step = code >>> 1 ^ -(code & 1), number = isDifference ? step : before + step;
      before = number;
      values.push(valueOf(number, isDifference ? kDigitsOfDifference : kDigits));
    }
    return values;
  }
}

function valueOf(code: number, digits: number): number {
  const size = Math.abs(code), least = 10 ** (digits - 1), sign = code < 0 ? -1 : 1;
  if (size >= kNan) return size === kNan ? NaN : sign * Infinity;
  if (size === 0) return 0;
  const mantissa = least + (size - 1) % (9 * least), exponent = kLeastExponent + Math.floor((size - 1) / (9 * least));
  return sign * Number(`${mantissa}e${exponent - digits + 1}`);
}
