// A chart or a picture as an SVG of its own: light, without the page's style sheet, with title, legend and caption.
import { svg } from './dom';
import { wrapped } from './figure_text';

const kInk = '#1b1f24', kMuted = '#59616b';
const kFont = 'system-ui, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif';
const kSeries = ['#b4bac3', '#3644b8', '#c04f00', '#0b7566', '#8d2a85', '#6b5600'];

/** The rules of style/base.css for charts, as attributes: not every program that reads SVG knows style sheets. */
const kLook: Readonly<Record<string, Readonly<Record<string, string>>>> = {
  'tick-label': { fill: kMuted }, 'band-label': { fill: kMuted }, 'point-name': { fill: kMuted },
  axis: { stroke: kMuted }, tick: { stroke: kMuted }, 'grid-line': { stroke: '#d9dde2' }, leader: { stroke: kMuted, 'stroke-width': '0.6' },
  'band-0': { fill: '#3644b8', 'fill-opacity': '0.14' }, 'band-1': { fill: '#3644b8', 'fill-opacity': '0.06' }, 'band-edge': { stroke: kMuted, 'stroke-dasharray': '1 3' },
  series: { 'stroke-linejoin': 'round' }, marker: { 'fill-opacity': '0.75' },
  line: { stroke: '#35e0ff', 'stroke-width': '1.5' }, 'line-halo': { stroke: '#000', 'stroke-width': '3.5' }, split: { stroke: '#fff', 'stroke-width': '1.5' },
  region: { fill: 'none', stroke: '#fff', 'stroke-width': '1.5' }, 'region-halo': { fill: 'none', stroke: '#000', 'stroke-width': '3' },
  ...Object.fromEntries(kSeries.flatMap((colour, i) => [[`series-${i}`, { stroke: colour }], [`marker-${i}`, { fill: colour, stroke: colour }]])),
};

/** A copy that needs no style sheet and has nothing that a pointer or a script would use. */
function plain(source: Element): Element {
  const copy = source.cloneNode(true) as Element;
  for (const element of [copy, ...copy.querySelectorAll('*')]) {
    if (element.tagName === 'text') element.setAttribute('fill', kInk);
    for (const name of element.classList) for (const [key, value] of Object.entries(kLook[name] ?? {})) element.setAttribute(key, value);
    if (element.classList.contains('ring')) element.setAttribute('fill', 'none');
    for (const { name } of [...element.attributes]) if (/^(class|style|tabindex|role|aria-.*|data-.*|on.*)$/.test(name)) element.removeAttribute(name);
  }
  return copy;
}

export interface LegendEntry { readonly name: string; readonly line: Readonly<Record<string, string | number>> }

function root(width: number, height: number, ...parts: (SVGElement | undefined)[]): SVGSVGElement {
  return svg('svg', { viewBox: `0 0 ${width} ${height}`, width, height, 'font-family': kFont, 'font-size': 13 },
    svg('rect', { width, height, fill: '#fff' }), ...parts);
}

const words = (text: string, x: number, y: number, size: number, more: Record<string, string | number> = {}): SVGElement =>
  svg('text', { x, y, 'font-size': size, fill: kInk, ...more }, text);

/** `caption` in lines from `top` on, and where it ends. */
function captionLines(caption: string, width: number, top: number): { parts: SVGElement[]; end: number } {
  const size = 15, lines = caption === '' ? [] : wrapped(caption, Math.floor((width - 32) / (0.53 * size)));
  return { parts: lines.map((line, i) => words(line, 16, top + (i + 1) * 21, size)), end: top + lines.length * 21 + (lines.length > 0 ? 14 : 0) };
}

/** The chart `drawing` as a file. `legend`: what the page has beside it and not in it. */
export function chartFigure(drawing: SVGSVGElement, title: string, caption: string, legend: readonly LegendEntry[]): SVGSVGElement {
  const box = drawing.viewBox.baseVal, width = box.width, parts: SVGElement[] = [words(title, 16, 26, 17, { 'font-weight': 650 })];
  let x = 16, y = 50;
  for (const { name, line } of legend) {
    const room = 44 + 7.4 * name.length + 22;
    if (x > 16 && x + room > width) { x = 16; y += 20; }
    parts.push(plain(svg('line', { ...line, x1: x, x2: x + 36, y1: y - 4, y2: y - 4 })) as SVGElement, words(name, x + 44, y, 13));
    x += room;
  }
  const top = legend.length > 0 ? y + 10 : 36, text = captionLines(caption, width, top + box.height);
  const chart = svg('g', { transform: `translate(${-box.x} ${top - box.y})`, fill: kInk }, ...[...drawing.children].filter((n) => !n.classList.contains('rule')).map(plain));
  return root(width, text.end, ...parts, chart, ...text.parts);
}

/** A colour bar: its colours by share from left to right, and words along it. */
export interface Bar {
  readonly colour: (share: number) => string;
  readonly ticks: readonly { readonly share: number; readonly label: string }[];
  readonly label: string;
}

const kBarSteps = 64, kBarHeight = 18;

function barParts(bar: Bar, width: number, top: number): SVGElement[] {
  const left = 60, long = width - 120;
  const stops = Array.from({ length: kBarSteps + 1 }, (_, i) => svg('stop', { offset: i / kBarSteps, 'stop-color': bar.colour(i / kBarSteps) }));
  return [
    svg('defs', {}, svg('linearGradient', { id: 'bar' }, ...stops)),
    svg('rect', { x: left, y: top, width: long, height: kBarHeight, fill: 'url(#bar)', stroke: kMuted }),
    ...bar.ticks.flatMap(({ share, label }) => [
      svg('line', { x1: left + share * long, x2: left + share * long, y1: top + kBarHeight, y2: top + kBarHeight + 6, stroke: kMuted }),
      words(label, left + share * long, top + kBarHeight + 22, 14, { 'text-anchor': 'middle' })]),
    words(bar.label, width / 2, top + kBarHeight + 44, 14, { 'text-anchor': 'middle' }),
  ];
}

export interface PictureParts {
  readonly picture: HTMLCanvasElement;
  /** Drawn over it, placed in units of `overlayWidth` to its width. */
  readonly overlay?: readonly Element[];
  readonly overlayWidth?: number;
  /** What each part, from left to right, shows. */
  readonly tags: readonly string[];
  readonly bar: Bar;
}

const kHead = 70;  // title and tags, above the picture
export const kLeastWidth = 1000;

/** How many times larger a picture is in its figure. */
export const enlargement = (width: number): number => Math.max(1, Math.ceil(kLeastWidth / width));

/** The frame of a picture as an SVG with `image` in it, or without. `place` is where the picture belongs. */
export function pictureFigure(parts: PictureParts, title: string, caption: string, image?: string):
    { drawing: SVGSVGElement; place: { x: number; y: number; width: number; height: number } } {
  const { picture, overlay = [], tags, bar } = parts, times = enlargement(picture.width);
  const width = picture.width * times, height = picture.height * times, bottom = kHead + height;
  const text = captionLines(caption, width, bottom + 84), place = { x: 0, y: kHead, width, height };
  const scale = width / (parts.overlayWidth ?? width);
  const drawing = root(width, text.end,
    words(title, 16, 28, 18, { 'font-weight': 650 }),
    ...tags.map((tag, i) => words(tag, 16 + i * width / tags.length, 58, 15)),
    image === undefined ? undefined : svg('image', { ...place, href: image, 'image-rendering': 'pixelated', preserveAspectRatio: 'none' }),
    svg('svg', { ...place, viewBox: `0 0 ${width / scale} ${height / scale}` }, ...overlay.map(plain)),
    ...barParts(bar, width, bottom + 14), ...text.parts);
  return { drawing, place };
}

export const svgText = (drawing: SVGSVGElement): string => '<?xml version="1.0" encoding="UTF-8"?>\n' + new XMLSerializer().serializeToString(drawing) + '\n';
