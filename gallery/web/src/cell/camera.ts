// The part of the picture that the stage shows, and its zoom.
import { clamp } from '../lib/numbers';
import type { Choice } from './choice';
import type { Rectangle, Viewport } from './painter';

const kMostZoom = 64;

export class Camera {
  /** Of the picture in pixels. */
  size = { width: 1, height: 1 };
  /** What is shown at first; undefined: the whole picture. */
  home: Rectangle | undefined;

  constructor(private readonly stage: HTMLElement, private readonly choice: Choice,
              private readonly change: (changes: { x: string; y: string; z: string }) => void) {}

  rectangles(): Rectangle[] {
    const box = this.stage.getBoundingClientRect(), scale = devicePixelRatio;
    const width = Math.max(4, Math.round(box.width * scale)), height = Math.max(1, Math.round(box.height * scale));
    if (this.choice.mode() !== 'side') return [{ x: 0, y: 0, width, height }];
    const half = Math.max(1, Math.floor(width / 2) - 1);
    return [{ x: 0, y: 0, width: half, height }, { x: half + 2, y: 0, width: width - half - 2, height }];
  }

  fitZoom(): number {
    const at = this.rectangles()[0]!;
    return Math.min(at.width / this.size.width, at.height / this.size.height);
  }

  view(): Viewport {
    const at = this.rectangles()[0]!;
    const z = this.choice.state.get('z'), whole = { x: 0, y: 0, ...this.size };
    const box = z === '' ? this.home ?? whole : whole;
    const zoom = z === '' || z === 'fit' ? Math.min(at.width / box.width, at.height / box.height) : clamp(this.choice.state.number('z') * devicePixelRatio, this.fitZoom() / 4, kMostZoom * 4);
    const x = this.choice.state.get('x') === '' ? box.x + box.width / 2 : this.choice.state.number('x');
    const y = this.choice.state.get('y') === '' ? box.y + box.height / 2 : this.choice.state.number('y');
    return { x: x - at.width / 2 / zoom, y: y - at.height / 2 / zoom, zoom };
  }

  /** The point of the picture in the middle of the stage. */
  private centre(): { x: number; y: number } {
    const view = this.view(), at = this.rectangles()[0]!;
    return { x: view.x + at.width / 2 / view.zoom, y: view.y + at.height / 2 / view.zoom };
  }

  /** `about` stays where it is on the stage. */
  zoomTo(zoom: number, about?: { x: number; y: number }): void {
    const next = clamp(zoom * devicePixelRatio, Math.min(this.fitZoom(), 1), kMostZoom * devicePixelRatio);
    const centre = this.centre(), fixed = about ?? centre, share = this.view().zoom / next;
    this.moveTo(fixed.x + (centre.x - fixed.x) * share, fixed.y + (centre.y - fixed.y) * share, next / devicePixelRatio);
  }

  zoomBy(factor: number, about?: { x: number; y: number }): void {
    this.zoomTo(this.view().zoom / devicePixelRatio * factor, about);
  }

  moveTo(x: number, y: number, zoom: number): void {
    const text = (value: number, most: number) => String(Number(clamp(value, 0, most).toFixed(2)));
    this.change({ x: text(x, this.size.width), y: text(y, this.size.height), z: String(Number(zoom.toPrecision(5))) });
  }

  /** By pixels of the picture. */
  moveBy(dx: number, dy: number): void {
    const { x, y } = this.centre();
    this.moveTo(x + dx, y + dy, this.view().zoom / devicePixelRatio);
  }

  fit(): void { this.change({ x: '', y: '', z: this.home ? 'fit' : '' }); }

  goHome(): void { this.change({ x: '', y: '', z: '' }); }

  /** Whether the whole picture is shown. */
  isWhole(): boolean {
    const z = this.choice.state.get('z');
    return z === 'fit' || (z === '' && !this.home);
  }

  /** The picture's point under the pointer. */
  pointAt(event: { clientX: number; clientY: number }): { x: number; y: number } {
    const box = this.stage.getBoundingClientRect(), view = this.view(), scale = devicePixelRatio;
    const across = (event.clientX - box.left) * scale, down = (event.clientY - box.top) * scale;
    const panes = this.rectangles(), pane = panes.filter((r) => across >= r.x).at(-1) ?? panes[0]!;
    return { x: view.x + (across - pane.x) / view.zoom, y: view.y + (down - pane.y) / view.zoom };
  }
}
