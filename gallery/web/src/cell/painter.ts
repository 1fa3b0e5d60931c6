// What a stage shows. gl_painter.ts paints it from float pictures, cpu_painter.ts does without WebGL 2, and
// png_painter.ts paints 8-bit pictures.

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
