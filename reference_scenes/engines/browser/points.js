// What the pages share: the points of a sphere that the pixels' centres see, and the picture on its way out.

/// For each pixel that sees the sphere its point and the normal there, in the camera's frame with x to the right, y upwards
/// and z away from it; and planes before and behind them all.
export function spherePoints({ width, height, window: [left, right, bottom, top], centre: c, radius }) {
  const points = [], normals = [];
  let near = Infinity, far = 0;
  const outside = c[0] * c[0] + c[1] * c[1] + c[2] * c[2] - radius * radius;
  for (let j = 0; j < height; ++j)
    for (let i = 0; i < width; ++i) {
      const x = left + (i + 0.5) * (right - left) / width, y = bottom + (j + 0.5) * (top - bottom) / height;
      const a = x * x + y * y + 1, b = x * c[0] + y * c[1] + c[2], discriminant = b * b - a * outside;
      if (discriminant <= 0 || b <= 0) continue;
      const t = outside / (b + Math.sqrt(discriminant));
      const point = [t * x, t * y, t];
      points.push(...point);
      near = Math.min(near, t / 2);
      far = Math.max(far, 2 * t);
      normals.push(...point.map((value, k) => (value - c[k]) / radius));
    }
  return points.length > 0 ? { points, normals, near, far } : { points, normals, near: 1, far: 2 };
}

let picture = new Float32Array(0), rowLength = 0;

/// Keeps the picture, RGBA with the lowest row first, for rowsOfPicture().
export function keepPicture(rgba, width) {
  rowLength = 3 * width;
  picture = new Float32Array(rgba.length / 4 * 3);
  for (let i = 0, k = 0; i < rgba.length; ++i) if (i % 4 !== 3) picture[k++] = rgba[i];
}

/// Rows as float32 RGB in base 64.
globalThis.rowsOfPicture = (first, count) => {
  const bytes = new Uint8Array(picture.buffer, 4 * first * rowLength, 4 * count * rowLength);
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
};
