// Without float pictures: the 8-bit pictures, at their only exposure.
import { pictureAt } from '../lib/single_file';
import type { CellPage, ShownPicture } from '../records';
import { drawPanes, type Painter, type Pane, type Viewport } from './painter';

export class PngPainter implements Painter {
  private readonly images = new Map<string, HTMLImageElement>();

  constructor(private readonly canvas: HTMLCanvasElement, private readonly data: CellPage,
              private readonly repaint: () => void, private readonly isWaiting: () => boolean) {}

  paint(width: number, height: number, panes: readonly Pane[]): void {
    drawPanes(this.canvas, width, height, panes, (context, { at, view, content }) => {
      context.imageSmoothingEnabled = view.zoom < 1;
      if (content.kind === 'picture') this.draw(context, this.data.engines[content.engine]?.picture, at, view);
      else if (content.kind === 'difference') this.drawDifference(context, content.a, content.b, at, view);
    });
  }

  private drawDifference(context: CanvasRenderingContext2D, a: number, b: number,
                         at: Pane['at'], view: Viewport): void {
    const first = this.data.engines[a], second = this.data.engines[b];
    const recorded = this.data.comparisons.find((c) =>
      (c.a === first?.name && c.b === second?.name) || (c.b === first?.name && c.a === second?.name));
    if (recorded?.picture) return this.draw(context, recorded.picture, at, view);
    this.draw(context, first?.picture, at, view);
    context.globalCompositeOperation = 'difference';
    this.draw(context, second?.picture, at, view);
  }

  private draw(context: CanvasRenderingContext2D, file: ShownPicture | null | undefined,
               at: Pane['at'], view: Viewport): void {
    if (!file) return;
    // The full-size file is needed only if no float picture is coming.
    const source = this.isWaiting() ? file.small : file.src;
    let image = this.images.get(source);
    if (!image) {
      image = new Image();
      image.src = pictureAt(source);
      image.addEventListener('load', this.repaint);
      this.images.set(source, image);
    }
    if (!image.complete || image.naturalWidth === 0) return;
    context.drawImage(image, at.x - view.x * view.zoom, at.y - view.y * view.zoom,
      file.width * view.zoom, file.height * view.zoom);
  }
}
