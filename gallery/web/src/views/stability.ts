// The hard cases: charts and rows of pictures as figures.
import { between, cssColour } from '../cell/colours';
import { h } from '../lib/dom';
import { addDrawnChartButtons } from '../lib/drawn_chart';
import { figureButton, type FigureSource } from '../lib/figure';
import { fileName } from '../lib/figure_text';
import { powerText } from '../lib/numbers';

export function stability(main: HTMLElement): void {
  addDrawnChartButtons(main);
  for (const row of main.querySelectorAll<HTMLElement>('.picture-four')) {
    const title = row.previousElementSibling?.textContent ?? '';
    for (const image of row.querySelectorAll('img')) image.loading = 'eager';
    row.after(h('div', { class: 'chart-foot' }, figureButton(`Close to a highlight, ${title}`, () => rowFigure(row, title))));
  }
}

/** The colours of studies/stability/pictures.cpp, of errors from 10⁻⁸ to 1. */
const kErrorColours = [0, 0, 0, 30, 60, 200, 210, 40, 40, 250, 210, 40, 255, 255, 255];

/** The pictures of a row in one figure. */
function rowFigure(row: HTMLElement, title: string): FigureSource {
  const images = [...row.querySelectorAll('img')], first = images[0];
  if (!first || images.some((image) => !image.complete || image.naturalWidth === 0)) throw new Error('The pictures are not loaded yet.');
  const width = first.naturalWidth, picture = h('canvas', { width: width * images.length, height: first.naturalHeight }), context = picture.getContext('2d');
  images.forEach((image, i) => context?.drawImage(image, i * width, 0));
  const tags = images.map((image) => image.alt), name = fileName('highlight', title);
  return {
    name, title: `Close to a highlight, ${title}`, caption: `A modified Phong highlight that fills the picture, ${title}. From left to right: ${tags.join('; ')}.`,
    content: { picture, tags, bar: { colour: (share) => cssColour(between(kErrorColours, share)), label: 'error of the peak, logarithmic', ticks: [-8, -6, -4, -2, 0].map((power, i) => ({ share: i / 4, label: powerText(power) })) } },
  };
}
