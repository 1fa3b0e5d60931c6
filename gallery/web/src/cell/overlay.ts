// Drawn over the pictures: the line, the pixel under the cursor, the divider.
import { svg } from '../lib/dom';
import { clamp } from '../lib/numbers';
import type { Choice } from './choice';
import type { Rectangle, Viewport } from './painter';

export function overlayOf(choice: Choice, panes: readonly Rectangle[], view: Viewport,
                          cursor: { x: number; y: number } | undefined,
                          outline: (transform: string) => SVGElement[]): SVGElement[] {
  const scale = devicePixelRatio, parts: SVGElement[] = [];
  const line = choice.line();
  for (const pane of panes) {
    const across = (x: number): number => (pane.x + (x - view.x) * view.zoom) / scale;
    const down = (y: number): number => (pane.y + (y - view.y) * view.zoom) / scale;
    parts.push(...outline(`translate(${across(0)} ${down(0)}) scale(${view.zoom / scale})`));
    if (line) {
      const ends = { x1: across(line.x0 + 0.5), y1: down(line.y0 + 0.5), x2: across(line.x1 + 0.5), y2: down(line.y1 + 0.5) };
      parts.push(svg('line', { ...ends, class: 'line-halo' }), svg('line', { ...ends, class: 'line' }));
    }
    if (cursor) {
      const size = Math.max(view.zoom / scale, 5), middle = 0.5 - size * scale / view.zoom / 2;
      parts.push(svg('rect', { class: 'pixel', x: across(cursor.x + middle), y: down(cursor.y + middle), width: size, height: size }));
    }
  }
  if (choice.mode() === 'slide') {
    const at = `${clamp(choice.state.number('split'), 0, 100)}%`;
    parts.push(svg('line', { class: 'line-halo', x1: at, x2: at, y1: 0, y2: '100%' }), svg('line', { class: 'split', x1: at, x2: at, y1: 0, y2: '100%' }));
  }
  return parts;
}
