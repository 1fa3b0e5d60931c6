// The button "Figure": what is shown as PNG, SVG, CSV or LaTeX, and its link. All of it is made on the page.
import { button, h } from './dom';
import { chartFigure, kLeastWidth, pictureFigure, svgText, type LegendEntry, type PictureParts } from './figure_svg';
import { csvText, latexFigure } from './figure_text';

export interface FigureSource {
  /** Of its files, without an ending. */
  readonly name: string;
  readonly title: string;
  readonly caption: string;
  /** What a CSV has, for its button; and its rows, the first with the names of the columns. Missing: there are no numbers. */
  readonly csv?: { readonly what: string; rows(): Iterable<readonly (string | number)[]> };
  /** A picture, or a chart with what the page has beside it. */
  readonly content: PictureParts | { readonly drawing: SVGSVGElement; readonly legend: readonly LegendEntry[] };
}

const isPicture = (content: FigureSource['content']): content is PictureParts => 'picture' in content;

export function saveFile(file: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  h('a', { href: address, download: file }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

const drawnOf = ({ content, title, caption }: FigureSource, image?: string): SVGSVGElement =>
  isPicture(content) ? pictureFigure(content, title, caption, image).drawing : chartFigure(content.drawing, title, caption, content.legend);

const svgOf = (source: FigureSource): string => svgText(drawnOf(source, isPicture(source.content) ? source.content.picture.toDataURL() : undefined));

/** The frame from its SVG, and a picture's own pixels over it, each as a square. */
async function pngOf(source: FigureSource): Promise<Blob> {
  const drawing = drawnOf(source), { content } = source, frame = new Image();
  const times = Math.max(1, Math.ceil(kLeastWidth / drawing.width.baseVal.value));
  drawing.setAttribute('width', String(drawing.width.baseVal.value * times));
  drawing.setAttribute('height', String(drawing.height.baseVal.value * times));
  frame.src = 'data:image/svg+xml,' + encodeURIComponent(svgText(drawing));
  await frame.decode();
  const canvas = h('canvas', { width: frame.width, height: frame.height }), context = canvas.getContext('2d');
  if (!context) throw new Error('no canvas');
  context.drawImage(frame, 0, 0);
  if (isPicture(content)) {
    const { place } = pictureFigure(content, source.title, source.caption);
    context.imageSmoothingEnabled = false;
    context.drawImage(content.picture, place.x, place.y, place.width, place.height);
    if (content.overlay?.length) context.drawImage(await overlayOf(drawing), 0, 0);
  }
  return new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('too large'))), 'image/png'));
}

/** Only what is drawn over the picture. */
async function overlayOf(drawing: SVGSVGElement): Promise<HTMLImageElement> {
  for (const child of [...drawing.children]) if (child.tagName !== 'svg') child.remove();
  const image = new Image();
  image.src = 'data:image/svg+xml,' + encodeURIComponent(svgText(drawing));
  await image.decode();
  return image;
}

/** `get` is asked each time that the button is pressed; it throws with a sentence if there is no figure. */
export function figureButton(what: string, get: () => FigureSource): HTMLButtonElement {
  const control = button('Figure', () => openPanel(what, get), { class: 'figure-button', 'aria-haspopup': 'dialog', 'aria-label': `Figure: ${what}`, title: 'Save or cite what is shown' });
  return control;
}

function openPanel(what: string, get: () => FigureSource): void {
  const status = h('p', { class: 'figure-status', role: 'status' });
  const panel = h('dialog', { class: 'figure-panel', 'aria-label': `Figure: ${what}` });
  const close = button('Close', () => panel.close());
  // Letters are commands of the page below.
  panel.addEventListener('keydown', (event) => event.stopPropagation());
  panel.addEventListener('close', () => panel.remove());
  panel.addEventListener('click', (event) => { if (event.target === panel) panel.close(); });
  const attempt = (act: () => void | Promise<void>, done: string) => async (): Promise<void> => {
    try {
      await act();
      status.textContent = done;
    } catch (error) {
      // A browser may let no page read a picture that came from a disk.
      status.textContent = error instanceof DOMException && error.name === 'SecurityError'
        ? 'The browser lets no page read this picture from a disk. In the gallery’s folder, type: python3 -m http.server --bind 127.0.0.1' : `It cannot be made: ${error instanceof Error ? error.message : String(error)}.`;
    }
  };
  const act = (label: string, run: () => void | Promise<void>, done: string): HTMLElement => button(label, () => void attempt(run, done)());
  const copy = (text: string, field: HTMLInputElement | HTMLTextAreaElement, named: string): HTMLElement =>
    act('Copy', () => (navigator.clipboard ? navigator.clipboard.writeText(text) : field.select()), navigator.clipboard ? `The ${named} is copied.` : 'Copy the marked text.');
  const labelled = (element: HTMLElement, name: string): HTMLElement => { element.setAttribute('aria-label', name); return element; };
  try {
    const source = get(), { name, csv } = source, latex = latexFigure(name, source.caption);
    const link = h('input', { readonly: true, 'aria-label': 'Link', value: location.href }), tex = h('textarea', { readonly: true, rows: 7, spellcheck: 'false', 'aria-label': 'LaTeX' }, latex);
    panel.append(h('h2', {}, source.title), h('p', { class: 'figure-caption' }, source.caption),
      h('div', { class: 'controls' },
        act('PNG', async () => saveFile(name + '.png', await pngOf(source)), `${name}.png is saved.`),
        act('SVG', () => saveFile(name + '.svg', new Blob([svgOf(source)], { type: 'image/svg+xml' })), `${name}.svg is saved.`),
        csv && act(`CSV: ${csv.what}`, () => saveFile(name + '.csv', new Blob([csvText(csv.rows())], { type: 'text/csv' })), `${name}.csv is saved.`),
        act('LaTeX', () => saveFile(name + '.tex', new Blob([latex], { type: 'text/x-tex' })), `${name}.tex is saved.`)),
      h('div', { class: 'figure-copy' }, tex, labelled(copy(latex, tex, 'LaTeX'), 'Copy the LaTeX'), link, labelled(copy(location.href, link, 'link'), 'Copy the link')));
  } catch (error) {
    panel.append(h('p', {}, error instanceof Error ? error.message : String(error)));
  }
  panel.append(status, close);
  (document.querySelector('main') ?? document.body).append(panel);
  panel.showModal();
}
