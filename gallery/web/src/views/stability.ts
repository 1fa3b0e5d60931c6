// The hard cases: the error of the textbook and of ours over exponent and angle, chosen by group, lobe and exponent.
import { Chart, rangeOf, type Series } from '../lib/chart';
import { pageData } from '../lib/data';
import { h, replaceDrawing, select } from '../lib/dom';
import { figureButton, type FigureSource } from '../lib/figure';
import { fileName } from '../lib/figure_text';
import { numberText, powerText, toNumber, type RecordNumber } from '../lib/numbers';
import { HashState } from '../lib/state';
import type { StabilityPage } from '../records';

const kLabels = ['largest error, of the peak', 'largest error, units in the last place'];
const kNoNumber = [10, 1e10];  // where NaN and infinity are drawn
const kNaive = 2, kOurs = 1;  // styles, as in the page's charts without script
type State = HashState<'group' | 'lobe' | 'kind' | 'n' | 'show'>;

export function stability(main: HTMLElement): void {
  const data = pageData<StabilityPage>();
  if (!data) return;
  const exponents = data.curves.map((c) => String(toNumber(c.exponent)));
  const state: State = new HashState({
    group: 'lobe', lobe: '', kind: '0', show: 'value',
    n: exponents.includes('1000000') ? '1000000' : exponents.at(-1) ?? '',
  });
  if (data.summaries.length > 0) replace(main, 'over-exponent-figure', overExponent(data, state));
  if (data.curves.length > 0) replace(main, 'over-angle-figure', overAngle(data, exponents, state));
  for (const row of main.querySelectorAll<HTMLElement>('.picture-four')) {
    const title = row.previousElementSibling?.textContent ?? '';
    for (const image of row.querySelectorAll('img')) image.loading = 'eager';
    row.after(h('div', { class: 'chart-foot' }, figureButton(`Close to a highlight, ${title}`, () => rowFigure(row, title))));
  }
}

/** The colours of studies/stability/pictures.cpp, of errors from 10⁻⁸ to 1. */
const kErrorColours = [[0, 0, 0], [30, 60, 200], [210, 40, 40], [250, 210, 40], [255, 255, 255]] as const;

function errorColour(share: number): string {
  const at = share * (kErrorColours.length - 1), from = Math.min(kErrorColours.length - 2, Math.floor(at)), part = at - from;
  return `rgb(${[0, 1, 2].map((c) => Math.round(kErrorColours[from]![c]! * (1 - part) + kErrorColours[from + 1]![c]! * part)).join(' ')})`;
}

/** The pictures of a row in one figure. */
function rowFigure(row: HTMLElement, title: string): FigureSource {
  const images = [...row.querySelectorAll('img')], first = images[0];
  if (!first || images.some((image) => !image.complete || image.naturalWidth === 0)) throw new Error('The pictures are not loaded yet.');
  const width = first.naturalWidth, picture = h('canvas', { width: width * images.length, height: first.naturalHeight }), context = picture.getContext('2d');
  images.forEach((image, i) => context?.drawImage(image, i * width, 0));
  const tags = images.map((image) => image.alt), name = fileName('highlight', title);
  return {
    name, title: `Close to a highlight, ${title}`, caption: `A modified Phong highlight that fills the picture, ${title}. From left to right: ${tags.join('; ')}.`,
    content: { picture, tags, bar: { colour: errorColour, label: 'error of the peak, logarithmic', ticks: [-8, -6, -4, -2, 0].map((power, i) => ({ share: i / 4, label: powerText(power) })) } },
  };
}

function replace(main: HTMLElement, id: string, content: HTMLElement): void {
  const drawing = main.querySelector(`#${id} > svg`);
  if (!drawing) return;
  // The caption describes the drawing; the lists show what is chosen.
  drawing.parentElement?.querySelector('figcaption')?.classList.add('without-script');
  replaceDrawing(drawing, content);
}

function overExponent(data: StabilityPage, state: State): HTMLElement {
  const unique = (values: string[]): { value: string; label: string }[] => [...new Set(values)].map((value) => ({ value, label: value.replace(/_/g, ' ') }));
  const chart = new Chart('Error over exponent', 380, () => ({
    name: `error-over-exponent-${state.get('group')}-${state.get('lobe') || 'all'}`, caption: `Cases: ${state.get('group')}; lobe: ${state.get('lobe') || 'the worst of all'}`,
  }));
  const change = (changes: Record<string, string>): void => { state.set(changes); draw(); };
  const group = select('Cases', unique(data.summaries.map((s) => s.group)), '', (v) => change({ group: v }), 'group');
  const lobe = select('Lobe', [{ value: '', label: 'the worst of all' }, ...unique(data.summaries.map((s) => s.lobe).filter((l) => l && !l.includes(',')))], '',
    (v) => change({ lobe: v }), 'lobe');
  const kind = select('Error', [{ value: '0', label: 'of the peak' }, { value: '1', label: 'in ulp' }], '', (v) => change({ kind: v }), 'kind');

  function draw(): void {
    const k = state.get('kind') === '1' ? 1 : 0;
    group.set(state.get('group'));
    lobe.set(state.get('lobe'));
    kind.set(String(k));
    const worst = new Map<number, { naive: number; ours: number }>();
    for (const s of data.summaries) {
      if (s.group !== state.get('group') || (state.get('lobe') !== '' && s.lobe !== state.get('lobe'))) continue;
      const n = toNumber(s.exponent), now = worst.get(n) ?? { naive: 0, ours: 0 };
      worst.set(n, { naive: Math.max(now.naive, toNumber(s.naive[k])), ours: Math.max(now.ours, toNumber(s.ours[k])) });
    }
    const x = [...worst.keys()].sort((a, b) => a - b);
    const values = x.flatMap((n) => [worst.get(n)!.naive, worst.get(n)!.ours]);
    const range = rangeOf(values.some((v) => v === Infinity) ? [...values, kNoNumber[k]!] : values, true, 45);
    // Infinity is at the top, an exact result at 0.
    const y = (name: 'naive' | 'ours'): number[] => x.map((n) => Math.min(worst.get(n)![name], range.to));
    chart.update({
      x: { label: 'exponent n', from: x[0] ?? 1, to: x.length > 1 ? x[x.length - 1]! : (x[0] ?? 1) * 10, logarithmic: true },
      y: { label: kLabels[k]!, ...range, logarithmic: true }, zero: true,
      series: [{ name: 'naive float32', x, y: y('naive'), style: kNaive }, { name: 'ours', x, y: y('ours'), style: kOurs }],
    });
  }
  state.onChange(draw);
  draw();
  return h('div', {}, h('div', { class: 'controls' }, group.element, lobe.element, kind.element), chart.element,
    h('p', { class: 'note' }, 'Against a reference of 50 digits. A line at the top edge means that the textbook gave no number.'));
}

function overAngle(data: StabilityPage, exponents: string[], state: State): HTMLElement {
  const chart = new Chart('A highlight over the angle', 380, () => ({
    name: `highlight-n${state.get('n')}-${state.get('show')}`, caption: `A modified Phong highlight, n = ${numberText(Number(state.get('n')), 4)}`,
  }));
  const change = (changes: Record<string, string>): void => { state.set(changes); draw(); };
  const exponent = select('Exponent n', exponents.map((n) => ({ value: n, label: numberText(Number(n), 4).replace(/^1 × /, '') })), '', (v) => change({ n: v }), 'exponent');
  const show = select('Show', [{ value: 'value', label: 'the highlight' }, { value: 'error', label: 'its error' }], '', (v) => change({ show: v }), 'show');

  function draw(): void {
    const at = Math.max(0, exponents.indexOf(state.get('n'))), curve = data.curves[at]!;
    const asError = state.get('show') === 'error';
    exponent.set(exponents[at]!);
    show.set(asError ? 'error' : 'value');
    const x = curve.degrees.map(toNumber), truth = curve.truth.map(toNumber);
    const values = (of: RecordNumber[]): number[] => of.map((v, i) => (asError ? Math.abs(toNumber(v) - truth[i]!) : toNumber(v)));
    const series: Series[] = [
      ...(asError ? [] : [{ name: 'truth', x, y: truth, style: 0 }]),
      { name: 'naive float32', x, y: values(curve.naive), style: kNaive }, { name: 'ours', x, y: values(curve.ours), style: kOurs },
    ];
    const drawn = series.flatMap((s) => s.y.filter((v) => !asError || v > 1e-20));
    const range = asError ? rangeOf(drawn, true, 20) : { from: 0, to: Math.min(2, rangeOf([0, 1, ...drawn], false).to) };
    chart.update({
      x: { label: 'angle between light and mirror direction (degrees)', from: 0, to: x[x.length - 1] || 1 },
      y: { label: asError ? '|value − truth|, of the peak' : 'value, of the peak', ...range, logarithmic: asError }, zero: true, series,
    });
  }
  state.onChange(draw);
  draw();
  return h('div', {}, h('div', { class: 'controls' }, exponent.element, show.element), chart.element);
}
