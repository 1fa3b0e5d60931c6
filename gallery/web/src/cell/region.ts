// The outline of the pixels that the verdict is about.
import { load } from '../lib/data';
import { svg } from '../lib/dom';
import type { PixelRuns } from '../records';

/** An SVG path along the borders of the pixels, in pixels of the picture. */
function outline({ width, height, runs }: PixelRuns): string {
  const inside = new Uint8Array(width * height);
  for (let i = 0; i + 1 < runs.length; i += 2) inside.fill(1, runs[i]!, runs[i]! + runs[i + 1]!);
  const is = (x: number, y: number): boolean => x >= 0 && y >= 0 && x < width && y < height && inside[y * width + x] === 1;
  const parts: string[] = [];
  // Borders between two rows as one line each, as far as they go; then between two columns.
  for (let y = 0; y <= height; ++y)
    for (let x = 0; x < width; ++x) {
      const from = x;
      while (x < width && is(x, y) !== is(x, y - 1)) ++x;
      if (x > from) parts.push(`M${from} ${y}H${x}`);
    }
  for (let x = 0; x <= width; ++x)
    for (let y = 0; y < height; ++y) {
      const from = y;
      while (y < height && is(x, y) !== is(x - 1, y)) ++y;
      if (y > from) parts.push(`M${x} ${from}V${y}`);
    }
  return parts.join('');
}

export class RegionOutline {
  private path: string | undefined;
  private asked = '';

  constructor(private readonly repaint: () => void) {}

  /** The outline of the region in that script, placed by `transform`; undefined until it is loaded. */
  drawn(script: string, transform: string): SVGElement[] {
    if (this.asked !== script) {
      this.asked = script;
      this.path = undefined;
      load<PixelRuns>('region', script).then((region) => { this.path = outline(region); this.repaint(); }, () => undefined);
    }
    if (this.path === undefined) return [];
    const look = { d: this.path, transform, 'vector-effect': 'non-scaling-stroke' };
    return [svg('path', { ...look, class: 'region-halo' }), svg('path', { ...look, class: 'region' })];
  }
}
