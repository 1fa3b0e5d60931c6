// A chart that the program drew into the page, as a figure.
import { h } from './dom';
import { figureButton, type FigureSource } from './figure';
import { fileName } from './figure_text';

export function drawnChartButton(chart: SVGSVGElement): HTMLElement {
  return figureButton(chart.querySelector('title')?.textContent ?? 'the chart', () => figureOf(chart));
}

/** Below each chart of the page. */
export function addDrawnChartButtons(main: HTMLElement): void {
  for (const chart of main.querySelectorAll<SVGSVGElement>('figure > svg.chart'))
    chart.after(h('div', { class: 'chart-foot' }, drawnChartButton(chart)));
}

function figureOf(chart: SVGSVGElement): FigureSource {
  const figure = chart.closest('figure'), section = chart.closest('section'), points = [...chart.querySelectorAll<SVGGElement>('g.point[data-x]')];
  const text = (place: ParentNode | null | undefined, selector: string): string => place?.querySelector(selector)?.textContent ?? '';
  const [x = '', y = ''] = [...chart.querySelectorAll('.axis-label')].map((label) => label.textContent ?? '');
  const what = figure?.dataset['name'] ?? '', title = (what ? text(section, 'h2') : text(chart, 'title')) || text(document, 'h1');
  // One of the section is about all its charts.
  const caption = text(figure, '.finding') || (section?.querySelectorAll('.finding').length === 1 ? text(section, '.finding') : '');
  return {
    name: fileName(document.body.dataset['view'] ?? '', what || title), title,
    caption: [`${title}: ${y}, over ${x}`, ...(caption ? [caption.replace(/\.$/, '')] : [])].join('. ') + '.',
    ...(points.length > 0 ? { csv: { what: `${points.length} points`, rows: () => [['name', x, y], ...points.map((p) => [p.dataset['key'] ?? '', Number(p.dataset['x']), Number(p.dataset['y'])])] } } : {}),
    content: { drawing: chart, legend: [] },
  };
}
