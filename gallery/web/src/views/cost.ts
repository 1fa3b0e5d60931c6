// The page on cost: the pointer or a key marks a variant in its table and in all charts of that table.
import { h, select } from '../lib/dom';
import { drawnChartButton } from '../lib/drawn_chart';
import { clamp } from '../lib/numbers';
import { HashState } from '../lib/state';

type State = HashState<'table' | 'variant'>;

export function cost(main: HTMLElement): void {
  const state: State = new HashState({ table: '', variant: '' });
  for (const section of main.querySelectorAll<HTMLElement>('section[id^="table-"]')) new CostTable(section, state);
}

class CostTable {
  private readonly number: string;
  private readonly rows: HTMLElement[];
  private readonly points: SVGGElement[];
  private readonly readouts: { chart: SVGSVGElement; place: HTMLElement }[] = [];

  constructor(private readonly section: HTMLElement, private readonly state: State) {
    this.number = section.id.slice('table-'.length);
    this.rows = [...section.querySelectorAll<HTMLElement>('tr[data-key]')];
    this.points = [...section.querySelectorAll<SVGGElement>('g.point[data-key]')];
    const details = section.querySelector<HTMLDetailsElement>('details.variants');
    if (details) details.open = true;
    for (const row of this.rows) {
      row.tabIndex = 0;
      this.listen(row);
    }
    for (const chart of section.querySelectorAll<SVGSVGElement>('svg.chart')) this.makeReadable(chart);
    this.chooseCharts();
    section.addEventListener('pointerleave', () => this.mark(this.pinned()));
    state.onChange(() => this.refresh());
    this.refresh();
  }

  /** One chart at a time, by the error that is chosen. */
  private chooseCharts(): void {
    const more = this.section.querySelector('details.more-charts');
    if (!more) return;
    const figures = [...this.section.querySelectorAll<HTMLElement>('figure[data-title]')];
    const show = (value: string): void => figures.forEach((figure, i) => { figure.hidden = i !== Number(value); });
    const list = select('Error', figures.map((figure, i) => ({ value: String(i), label: figure.dataset['title'] ?? '' })), '0', show);
    figures[0]!.before(h('div', { class: 'controls' }, list.element));
    more.before(...figures.slice(1));
    more.remove();
    show('0');
  }

  private makeReadable(chart: SVGSVGElement): void {
    const place = h('output', { class: 'readout' });
    this.readouts.push({ chart, place });
    chart.after(h('div', { class: 'chart-foot' }, place, drawnChartButton(chart)));
    const points = this.points.filter((p) => chart.contains(p));
    // In the order of the time axis.
    const across = (p: SVGGElement): number => Number(p.dataset['x']);
    points.sort((a, b) => across(a) - across(b));
    // The points of a chart are one stop for the tab key; arrow keys go from point to point.
    chart.setAttribute('role', 'group');
    chart.setAttribute('aria-roledescription', 'chart');
    points.forEach((point, i) => {
      point.setAttribute('role', 'img');
      point.setAttribute('aria-label', point.querySelector('title')?.textContent ?? '');
      point.setAttribute('tabindex', i === 0 ? '0' : '-1');
      this.listen(point);
      point.addEventListener('keydown', (event) => {
        const step = { ArrowLeft: -1, ArrowRight: 1, Home: -points.length, End: points.length }[event.key];
        if (!step) return;
        event.preventDefault();
        points[clamp(i + step, 0, points.length - 1)]!.focus();
      });
      point.addEventListener('focus', () => { for (const other of points) other.setAttribute('tabindex', other === point ? '0' : '-1'); });
    });
  }

  private listen(element: HTMLElement | SVGGElement): void {
    const key = element.dataset['key'] ?? '';
    element.addEventListener('pointerenter', () => this.mark(key));
    element.addEventListener('focus', () => this.mark(key));
    element.addEventListener('blur', () => this.mark(this.pinned()));
    element.addEventListener('click', () => this.pin(key));
    element.addEventListener('keydown', (event) => {
      if (!(event instanceof KeyboardEvent) || (event.key !== 'Enter' && event.key !== ' ')) return;
      event.preventDefault();
      this.pin(key);
    });
  }

  private pin(key: string): void {
    const again = this.pinned() === key;
    this.state.set(again ? { table: '', variant: '' } : { table: this.number, variant: key });
    this.refresh();
  }

  private pinned(): string { return this.state.get('table') === this.number ? this.state.get('variant') : ''; }

  private refresh(): void {
    const key = this.pinned();
    this.mark(key);
    if (key !== '' && location.hash.includes('=')) this.section.scrollIntoView({ block: 'nearest' });
  }

  private mark(key: string): void {
    for (const element of [...this.rows, ...this.points]) {
      const on = key !== '' && element.dataset['key'] === key;
      element.classList.toggle('marked', on);
      if (on && element instanceof HTMLElement) scrollWithin(element);
    }
    for (const { chart, place } of this.readouts) {
      const point = this.points.find((p) => chart.contains(p) && p.dataset['key'] === key);
      place.textContent = point?.querySelector('title')?.textContent ??
        (key === '' ? 'Point at the chart or the table, or use arrow keys; Enter keeps a variant marked.' : `${key}: no error that can be drawn`);
    }
  }
}

/** Scrolls the table to a row, never the page. */
function scrollWithin(row: HTMLElement): void {
  const box = row.closest<HTMLElement>('.table-wrap');
  if (!box || box.scrollHeight <= box.clientHeight) return;
  const head = box.querySelector('thead')?.offsetHeight ?? 0;
  if (row.offsetTop < box.scrollTop + head) box.scrollTop = row.offsetTop - head;
  else if (row.offsetTop + row.offsetHeight > box.scrollTop + box.clientHeight) box.scrollTop = row.offsetTop + row.offsetHeight - box.clientHeight;
}
