// The viewer's content as a figure: the picture, its colour bar, a caption, and the pixels' values.
import { fileName } from '../lib/figure_text';
import type { FigureSource } from '../lib/figure';
import type { Bar, PictureParts } from '../lib/figure_svg';
import { numberText, percentText } from '../lib/numbers';
import { kMeasures } from './choice';
import { colourAt, cssColour, encoded } from './colours';
import { valueOfMap } from './maps';
import { kDecades, type ViewerState } from './viewer_state';

const grey = (v: number): string => cssColour([255 * v, 255 * v, 255 * v]);
const kTicks = [0, 0.25, 0.5, 0.75, 1];

/** The colour of a signed difference, as float_painter.ts paints it. */
function signedColour(share: number): string {
  const mean = 2 * share - 1, strength = Math.sqrt(Math.abs(mean)), end = mean > 0 ? [1, 0.45, 0.2] : [0.3, 0.65, 1];
  return cssColour(end.map((c) => 255 * (0.06 * (1 - strength) + c * strength)));
}

const linear = (top: number, label: string, colour: Bar['colour']): Bar =>
  ({ colour, label, ticks: kTicks.map((share) => ({ share, label: numberText(share * top) })) });
const logarithmic = (top: number, label: string, colour: Bar['colour']): Bar => ({
  colour, label: label + ', logarithmic',
  ticks: Array.from({ length: kDecades + 1 }, (_, i) => ({ share: i / kDecades, label: numberText(top * 10 ** (i - kDecades)) })),
});

export function barOf(viewer: ViewerState, a: number, b: number): Bar {
  const { choice } = viewer, isFalse = viewer.isFalseColour(), map = viewer.mapOf(a, b);
  if (map) {
    const colour = (share: number): string => colourAt('magma', share);
    return (isFalse ? logarithmic : linear)(viewer.white(a, b), map.title, colour);
  }
  if (choice.mode() === 'diff') {
    const white = viewer.white(a, b), measure = choice.measure(), unit = measure === 'relative' ? '' : ', radiance';
    const label = `${kMeasures.find((m) => m.value === measure)?.label ?? ''}${unit}`;
    if (measure === 'signed')
      return { colour: signedColour, label, ticks: kTicks.map((share) => ({ share, label: numberText((2 * share - 1) * white) })) };
    return isFalse ? logarithmic(white, label, (share) => colourAt('inferno', share)) : linear(white, label, grey);
  }
  if (isFalse) return logarithmic(viewer.look(a, b).top, 'radiance, mean of red, green and blue', (share) => colourAt('viridis', share));
  return linear(2 ** -choice.stops(), 'radiance, shown as sRGB', (share) => grey(encoded(share)));
}

/** The pixels that the stage shows of the picture. */
function shownPixels(viewer: ViewerState): { left: number; top: number; right: number; bottom: number } {
  const { camera } = viewer, view = camera.view(), pane = camera.rectangles()[0]!, { width, height } = camera.size;
  const inside = (v: number, most: number): number => Math.max(0, Math.min(most, v));
  return { left: inside(Math.floor(view.x), width), top: inside(Math.floor(view.y), height),
    right: inside(Math.ceil(view.x + pane.width / view.zoom), width), bottom: inside(Math.ceil(view.y + pane.height / view.zoom), height) };
}

function* rowsOf(viewer: ViewerState, a: number, b: number): Generator<(string | number)[]> {
  const { left, top, right, bottom } = shownPixels(viewer), { pictures, choice } = viewer, map = viewer.mapOf(a, b);
  const name = (i: number): string => choice.data.engines[i]!.name, rgb = (of: string): string[] => ['r', 'g', 'b'].map((c) => `${of}.${c}`);
  yield map ? ['x', 'y', map.title] : ['x', 'y', ...rgb(name(a)), ...rgb(name(b)), ...rgb('difference')];
  const none = [NaN, NaN, NaN];
  for (let y = top; y < bottom; ++y)
    for (let x = left; x < right; ++x)
      yield map ? [x, y, valueOfMap(map, x, y) ?? NaN]
        : [x, y, ...pictures.valueAt(a, x, y) ?? none, ...pictures.valueAt(b, x, y) ?? none, ...pictures.differenceAt(a, b, x, y) ?? none];
}

/** `painted`: what the stage shows. */
export function figureOf(viewer: ViewerState, painted: Omit<PictureParts, 'bar' | 'tags'>): FigureSource {
  const { choice, data, camera } = viewer, a = choice.engine('a'), b = choice.engine('b'), mode = choice.mode(), map = viewer.mapOf(a, b);
  const engine = (i: number): string => data.engines[i]?.title ?? '', shown = viewer.isFlipped() ? b : a;
  const measure = kMeasures.find((m) => m.value === choice.measure())!.label;
  const what = map ? map.title : mode === 'diff' ? measure : 'radiance';
  const title = mode === 'flip' ? engine(shown) : mode === 'diff' ? `${what}, a = ${engine(a)}, b = ${engine(b)}` : `${engine(a)} and ${engine(b)}`;
  const worst = viewer.worstPixel(a, b), bar = barOf(viewer, a, b);
  const words = [
    data.label || data.id, title,
    mode === 'diff' ? `White is ${numberText(viewer.white(a, b))}` : `Exposure ${numberText(choice.stops())} stops`,
    ...(worst && a !== b && mode !== 'flip' ? [`${map ? map.title : 'Largest difference'}${map ? ' at most' : ''} ${choice.measure() === 'relative' && mode === 'diff' && !map ? percentText(worst.value) : numberText(worst.value)}, at pixel (${worst.x}, ${worst.y})`] : []),
  ];
  const { left, top, right, bottom } = shownPixels(viewer), isWhole = right - left === camera.size.width && bottom - top === camera.size.height;
  if (!isWhole) words.push(`Pixels ${left} to ${right - 1} across and ${top} to ${bottom - 1} down of ${camera.size.width} × ${camera.size.height}`);
  const short = (i: number): string => data.engines[i]?.name ?? '';
  const pair = short(a) === 'lobelia' ? [short(b)] : short(b) === 'lobelia' ? [short(a)] : [short(a), short(b)];
  const count = (right - left) * (bottom - top);
  return {
    name: fileName(data.id, ...(mode === 'flip' ? [short(shown)] : pair), map ? map.id : mode === 'diff' ? 'difference' : mode === 'flip' ? '' : mode),
    title: `${data.label || data.id}: ${title}`,
    caption: words.join('. ') + '.',
    ...(viewer.isFloat ? { csv: { what: map ? `${map.title} at ${numberText(count, 7)} pixels` : `both pictures and their difference at ${numberText(count, 7)} pixels`, rows: () => rowsOf(viewer, a, b) } } : {}),
    content: { ...painted, bar, tags: mode === 'side' || mode === 'slide' ? [engine(a), engine(b)] : [] },
  };
}
