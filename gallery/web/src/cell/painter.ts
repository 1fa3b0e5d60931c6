// Paints the picture on a stage: float_painter.ts from float pictures, png_painter.ts from 8-bit pictures.

import type { FloatPicture } from './half_picture';

/** Pixel (x, y) of the picture is at the pane's top left; a pixel has `zoom` device pixels. */
export interface Viewport { readonly x: number; readonly y: number; readonly zoom: number }

export interface Rectangle { readonly x: number; readonly y: number; readonly width: number; readonly height: number }

export type Measure = 'absolute' | 'relative' | 'signed';

export type Content =
  | { readonly kind: 'picture'; readonly engine: number }
  | { readonly kind: 'difference'; readonly a: number; readonly b: number; readonly measure: Measure; readonly white: number }
  | { readonly kind: 'map'; readonly picture: FloatPicture; readonly white: number };

export interface Pane { readonly at: Rectangle; readonly view: Viewport; readonly content: Content }

export interface Look {
  readonly stops: number;
  readonly falseColour: boolean;
  /** The largest value of false colour, and the number of decades below it. */
  readonly top: number;
  readonly decades: number;
}

export interface Painter {
  /** In device pixels. */
  paint(width: number, height: number, panes: readonly Pane[], look: Look): void;
}

/** Draws each pane over the background, and nothing beyond its border. */
export function drawPanes(canvas: HTMLCanvasElement, width: number, height: number, panes: readonly Pane[],
                          draw: (context: CanvasRenderingContext2D, pane: Pane) => void): void {
  const context = canvas.getContext('2d');
  if (!context) return;
  canvas.width = width;
  canvas.height = height;
  context.fillStyle = '#212124';
  context.fillRect(0, 0, width, height);
  for (const pane of panes) {
    const { x, y, width: across, height: down } = pane.at;
    context.save();
    context.beginPath();
    context.rect(x, y, across, down);
    context.clip();
    draw(context, pane);
    context.restore();
  }
}
