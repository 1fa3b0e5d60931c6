// Pixels under a line, a step of one pixel apart.

export interface Line { readonly x0: number; readonly y0: number; readonly x1: number; readonly y1: number }

/** Those inside the picture, with how far along the line they are. */
export function lineAcross(line: Line, width: number, height: number): { x: number; y: number; along: number }[] {
  const length = Math.hypot(line.x1 - line.x0, line.y1 - line.y0), count = Math.min(1e5, Math.ceil(length));
  const points = [];
  for (let i = 0; i <= count; ++i) {
    const share = count === 0 ? 0 : i / count;
    const x = Math.round(line.x0 + share * (line.x1 - line.x0)), y = Math.round(line.y0 + share * (line.y1 - line.y0));
    if (x >= 0 && y >= 0 && x < width && y < height) points.push({ x, y, along: share * length });
  }
  return points;
}

export function sampled(points: readonly { x: number; y: number; along: number }[],
                        valueAt: (x: number, y: number) => readonly number[] | undefined): { x: number[]; y: number[] } {
  return {
    x: points.map((p) => p.along),
    y: points.map((p) => {
      const value = valueAt(p.x, p.y);
      return value ? (value[0]! + value[1]! + value[2]!) / 3 : NaN;
    }),
  };
}
