// The grid: any two axes as rows and columns, coloured by any metric, filtered, failures first.
import { colourAt, cssGradient } from '../cell/colours';
import { pageData } from '../lib/data';
import { announce, button, h, isTyping, select } from '../lib/dom';
import { numberText, percentText, toNumber } from '../lib/numbers';
import { pageAt, pictureAt } from '../lib/single_file';
import { HashState } from '../lib/state';
import type { GridCell, GridMetric, GridPage } from '../records';

/** Worst first. */
const kFlaws = ['damaged', 'lost', 'changed'];
const kSeverity = [...kFlaws, 'failed', 'differs', 'undecided', 'unsealed', 'unchecked', 'missing', 'pass'];
const kNone = '-1';
/** In place of an engine: the worst of all engines. */
const kAll = '*';

export function grid(main: HTMLElement): void {
  const data = pageData<GridPage>();
  const first = main.querySelector('.grid-section');
  if (data && first && data.cells.length > 0) new GridView(main, first, data);
}

function metricText(metric: GridMetric, value: number): string {
  return metric.unit === 'share' ? percentText(value) : metric.unit === 'count' ? numberText(value, 9) : numberText(value);
}

const sentence = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

function groupedBy(cells: readonly GridCell[], keyOf: (cell: GridCell) => string): Map<string, GridCell[]> {
  const groups = new Map<string, GridCell[]>();
  for (const cell of cells) {
    const key = keyOf(cell), group = groups.get(key);
    if (group) group.push(cell); else groups.set(key, [cell]);
  }
  return groups;
}

type AxisKey = 'rows' | 'cols' | 'group';
interface CellParts { readonly element: HTMLElement; readonly value: HTMLElement; readonly swatch: HTMLElement }

class GridView {
  private readonly state;
  private readonly place = h('div', { id: 'grid', class: 'grid-place' });
  private readonly count = h('output', { class: 'count' });
  private readonly legend = h('div', { class: 'legend-bar' });
  private readonly find = h('input', { type: 'search', placeholder: 'blinn 128', id: 'find', 'aria-keyshortcuts': '/' });
  private readonly axes: Record<AxisKey, ReturnType<typeof select>>;
  private readonly colour;
  private readonly status;
  private readonly order;
  private readonly made = new Map<GridCell, CellParts>();
  private readonly haystack = new Map<GridCell, string>();

  constructor(main: HTMLElement, first: Element, private readonly data: GridPage) {
    const { rows, groups, columns } = data.layout;
    this.state = new HashState({
      rows: String(rows), cols: String(columns), group: String(groups), find: '', status: '', order: this.isReport() || this.isList() ? 'worst' : 'grid',
      colour: this.colourChoices()[0]?.value ?? 'status',
    });
    const named = data.axes.map((axis, i) => ({ value: String(i), label: axis.name }));
    const axis = (label: string, key: AxisKey): ReturnType<typeof select> =>
      select(label, key === 'cols' ? named : [...named, { value: kNone, label: 'none' }], '', (value) => this.takeAxis(key, value));
    this.axes = { rows: axis('Rows', 'rows'), cols: axis('Columns', 'cols'), group: axis('Grouped by', 'group') };
    this.colour = select('Colour', [...this.colourChoices(), { value: 'status', label: 'status alone' }], '',
      (colour) => this.change({ colour }));
    this.status = select('Status', [{ value: '', label: 'any' },
      ...data.statuses.filter((s) => data.cells.some((c) => c.status === s.name)).map((s) => ({ value: s.name, label: s.word }))], '',
      (status) => this.change({ status }));
    this.order = select('Order', [{ value: 'grid', label: this.isList() ? 'by name' : 'the grid' }, { value: 'worst', label: 'failures first' }], '',
      (order) => this.change({ order }));
    this.find.addEventListener('input', () => this.change({ find: this.find.value }));
    const words = new Map(data.statuses.map((s) => [s.name, s.word]));
    for (const cell of data.cells) this.haystack.set(cell, `${cell.label} ${cell.id} ${words.get(cell.status) ?? cell.status}`.toLowerCase());

    const bar = h('div', { class: 'grid-bar', role: 'search', 'aria-label': 'The grid' },
      h('label', {}, h('span', {}, 'Find'), this.find), this.status.element, this.order.element, this.colour.element,
      this.isList() ? null : h('div', { class: 'axes-choice' }, this.axes.rows.element,
        button('⇄', () => this.takeAxis('rows', this.state.get('cols')),
          { 'aria-label': 'Exchange rows and columns', title: 'Exchange rows and columns (x)', 'aria-keyshortcuts': 'x' }),
        this.axes.cols.element, ...(data.axes.length > 2 ? [this.axes.group.element] : [])),
      this.count, this.legend);
    first.before(bar, this.place);
    for (const section of main.querySelectorAll('.grid-section')) section.remove();
    this.state.onChange(() => this.refresh());
    document.addEventListener('keydown', (event) => this.key(event));
    this.refresh();
  }

  private isReport(): boolean { return this.data.noun === 'pair'; }

  /** One axis, too long for a line. */
  private isList(): boolean { return this.data.layout.columns < 0; }

  private colourChoices(): { value: string; label: string }[] {
    const engines = this.data.engines.length > 1 ? [{ name: kAll, shortTitle: 'Worst of all' }, ...this.data.engines] : this.data.engines;
    return engines.flatMap((engine) => {
      const has = this.data.metrics.filter((_, m) => this.data.cells.some((c) => this.valuesOf(c, engine.name, m).some(Number.isFinite)));
      const list = has.map((metric) => ({ value: `${engine.name}/${metric.id}`, label: `${engine.shortTitle}: ${metric.title}` }));
      const main = list.findIndex((c) => c.value.endsWith('/max_rel_peak'));
      return main > 0 ? [list[main]!, ...list.slice(0, main), ...list.slice(main + 1)] : list;
    });
  }

  private key(event: KeyboardEvent): void {
    if (isTyping(event)) return;
    if (event.key === '/') this.find.focus();
    else if (event.key === 'x') this.takeAxis('rows', this.state.get('cols'));
    else return;
    event.preventDefault();
  }

  /** Uses an axis in one place only: the place that had it gets the axis it replaces. */
  private takeAxis(key: AxisKey, value: string): void {
    const before = this.state.get(key), changes: Partial<Record<typeof key, string>> = { [key]: value };
    for (const other of ['rows', 'cols', 'group'] as const)
      if (other !== key && value !== kNone && this.state.get(other) === value) changes[other] = before;
    if (changes.cols === kNone) changes.cols = this.data.axes.findIndex((_, i) => String(i) !== value).toString();
    this.change(changes);
  }

  private change(changes: Parameters<GridView['state']['set']>[0]): void {
    this.state.set(changes);
    this.refresh();
  }

  /** The axis from the link; if that is no axis, the usual one. */
  private axis(key: AxisKey): number {
    const { rows, groups, columns } = this.data.layout, usual = { rows, cols: columns, group: groups }[key];
    const asked = this.state.number(key), isAxis = Number.isInteger(asked) && asked >= 0 && asked < this.data.axes.length;
    const axis = isAxis || (asked === -1 && key !== 'cols') ? asked : usual;
    const taken = key === 'cols' ? [] : key === 'rows' ? [this.axis('cols')] : [this.axis('cols'), this.axis('rows')];
    return taken.includes(axis) ? -1 : axis;
  }

  private refresh(): void {
    const { state } = this;
    if (this.find.value !== state.get('find')) this.find.value = state.get('find');
    for (const key of ['rows', 'cols', 'group'] as const) this.axes[key].set(String(this.axis(key)));
    const status = this.data.statuses.some((s) => s.name === state.get('status')) ? state.get('status') : '';
    this.colour.set(this.metric() ? state.get('colour') : 'status');
    this.status.set(status);
    this.order.set(state.get('order') === 'worst' ? 'worst' : 'grid');
    const words = state.get('find').toLowerCase().split(/\s+/).filter(Boolean);
    const shown = this.data.cells.filter((cell) => (!status || cell.status === status) &&
      words.every((word) => this.haystack.get(cell)!.includes(word)));
    const text = `showing ${shown.length} of ${this.data.cells.length} ${this.data.noun}s`;
    if (this.count.textContent && this.count.textContent !== text) announce(text);
    this.count.textContent = text;
    this.paint(shown);
    this.place.replaceChildren(...(shown.length === 0 ? [h('p', { class: 'absent' }, `No ${this.data.noun} is like that.`)]
      : state.get('order') === 'worst' || this.isList() ? [this.list(shown)] : this.sections(shown)));
  }

  // ---- colours

  private metric(): { engine: string; index: number; metric: GridMetric } | undefined {
    const text = this.state.get('colour'), slash = text.indexOf('/');
    const index = this.data.metrics.findIndex((m) => m.id === text.slice(slash + 1));
    const engine = text.slice(0, slash), metric = this.data.metrics[index];
    const isKnown = engine === kAll || this.data.engines.some((e) => e.name === engine);
    return slash > 0 && metric && isKnown ? { engine, index, metric } : undefined;
  }

  private valuesOf(cell: GridCell, engine: string, index: number): number[] {
    const engines = engine === kAll ? this.data.engines.map((e) => e.name) : [engine];
    return engines.map((name) => (Object.hasOwn(cell.metrics, name) ? toNumber(cell.metrics[name]?.[index]) : NaN))
      .filter((value) => !Number.isNaN(value));
  }

  private valueOf(cell: GridCell): number {
    const by = this.metric(), values = by ? this.valuesOf(cell, by.engine, by.index) : [];
    if (values.length === 0) return NaN;
    return by!.metric.moreIsBetter ? Math.min(...values) : values.reduce((p, q) => (Math.abs(q) > Math.abs(p) ? q : p));
  }

  /** An error's value without its sign. */
  private sizeOf(cell: GridCell): number {
    const value = this.valueOf(cell);
    return this.metric()?.metric.moreIsBetter ? value : Math.abs(value);
  }

  private paint(shown: readonly GridCell[]): void {
    const by = this.metric();
    const values = by ? this.data.cells.map((c) => this.sizeOf(c)).filter(Number.isFinite) : [];
    const isSigned = by !== undefined && this.data.cells.some((c) => this.valueOf(c) < 0);
    const positive = values.filter((v) => v > 0), low = Math.min(...positive), high = Math.max(...positive);
    // Errors span decades; likenesses do not.
    const logarithmic = by !== undefined && !by.metric.moreIsBetter && positive.length > 0 && high > 20 * low;
    const from = logarithmic ? low : Math.min(...values), to = logarithmic ? high : Math.max(...values);
    for (const cell of shown) {
      const parts = this.cell(cell), value = this.valueOf(cell), size = this.sizeOf(cell);
      const share = logarithmic ? (size > 0 ? Math.log(size / from) / Math.log(to / from) : 0) : (size - from) / (to - from || 1);
      const isShown = by !== undefined && !Number.isNaN(value);
      parts.value.textContent = by ? metricText(by.metric, value) : '';
      parts.swatch.style.background = isShown ? colourAt('viridis', Number.isFinite(value) ? share : 1) : '';
      parts.swatch.hidden = !isShown;
    }
    if (!by || values.length === 0) { this.legend.replaceChildren(); return; }
    const ramp = h('span', { class: 'ramp' });
    ramp.style.background = cssGradient('viridis');
    this.legend.replaceChildren(h('span', {}, metricText(by.metric, from)), ramp, h('span', {}, metricText(by.metric, to)),
      h('span', {}, (logarithmic ? 'logarithmic. ' : '') + (isSigned ? 'Coloured without its sign. ' : '') + by.metric.meaning));
  }

  // ---- cells

  private cell(cell: GridCell): CellParts {
    const known = this.made.get(cell);
    if (known) return known;
    const status = this.data.statuses.find((s) => s.name === cell.status);
    const words = `${cell.label || cell.id}: ${status?.word ?? cell.status}`;
    const image = ({ src, width, height }: NonNullable<GridCell['picture']>, alt: string): HTMLImageElement =>
      h('img', { loading: 'lazy', decoding: 'async', alt, width, height, src: pictureAt(src) });
    const picture = cell.picture
      ? image(cell.picture, words)
      : h('span', { class: 'no-picture' }, 'no picture', h('span', { class: 'unseen' }, ', ' + words));
    const swatch = h('span', { class: 'swatch', hidden: true }), value = h('span', { class: 'value' });
    const element = h('div', { class: `cell ${cell.status}` },
      h('a', { href: pageAt(cell.href), title: words, class: cell.beside ? 'pictures-beside' : undefined }, picture, ...(cell.beside ?? []).map((one) => image(one, '')), swatch),
      h('span', { class: 'cell-foot' }, h('span', { class: `status ${cell.status}`, title: status?.word },
        h('span', { 'aria-hidden': 'true' }, status?.mark ?? ''), h('span', { class: kFlaws.includes(cell.status) ? 'word' : 'unseen' }, status?.word ?? '')), value));
    const parts = { element, value, swatch };
    this.made.set(cell, parts);
    return parts;
  }

  private list(shown: readonly GridCell[]): HTMLElement {
    const by = this.metric();
    const badness = (cell: GridCell): number => {
      const size = this.sizeOf(cell);
      return Number.isNaN(size) ? -Infinity : by?.metric.moreIsBetter ? -size : size;
    };
    const rank = (cell: GridCell): number => kSeverity.indexOf(cell.status);
    // A report has its pairs in an order of its own: by how far the worst figure is over its limit.
    const isAsWritten = this.isReport() && this.state.get('colour') === this.state.defaults.colour;
    const byName = this.isList() && this.state.get('order') !== 'worst';
    const sorted = byName ? [...shown].sort((p, q) => (p.label < q.label ? -1 : 1)) : isAsWritten && this.isList() ? shown
      : [...shown].sort((p, q) => rank(p) - rank(q) || (badness(q) > badness(p) ? 1 : badness(q) < badness(p) ? -1 : 0));
    return h('ul', { class: this.isReport() ? 'cell-list of-pairs' : 'cell-list' }, ...sorted.map((cell) =>
      h('li', {}, this.cell(cell).element, h('div', {}, h('a', { href: pageAt(cell.href), class: 'cell-name' }, cell.label || cell.id),
        cell.finding ? h('p', { class: 'finding' }, cell.finding) : null))));
  }

  private sections(shown: readonly GridCell[]): HTMLElement[] {
    const { axes } = this.data, rows = this.axis('rows'), cols = this.axis('cols'), group = this.axis('group');
    const rest = axes.map((_, i) => i).filter((i) => ![rows, cols, group].includes(i));
    const isPlaced = (cell: GridCell): boolean => !cell.at.includes(-1), homeless = shown.filter((cell) => !isPlaced(cell));
    const bySection = groupedBy(shown.filter(isPlaced), (cell) => rest.map((i) => String(cell.at[i]).padStart(6, '0')).join(' '));
    const sections = [...bySection].sort(([p], [q]) => (p < q ? -1 : 1)).map(([, cells], i) => {
      const label = rest.map((axis) => `${axes[axis]!.name}: ${axes[axis]!.values[cells[0]!.at[axis]!]}`).join(' · ');
      return this.section(`grid-${i + 1}`, sentence(label) || 'The grid', cells, rows, cols, group);
    });
    if (homeless.length > 0)
      sections.push(h('section', { class: 'grid-section' }, h('h2', {}, 'Cells that have no place on the axes'), this.list(homeless)));
    return sections;
  }

  private section(id: string, label: string, cells: readonly GridCell[], rows: number, cols: number, group: number): HTMLElement {
    const values = (axis: number): number[] =>
      axis < 0 ? [-1] : [...new Set(cells.map((c) => c.at[axis]!))].sort((p, q) => p - q);
    const at = (cell: GridCell, axis: number): number => (axis < 0 ? -1 : cell.at[axis]!);
    const byPlace = groupedBy(cells, (cell) => `${at(cell, rows)} ${at(cell, group)} ${at(cell, cols)}`);
    const groups = values(group), columns = values(cols), { axes } = this.data;
    const name = (axis: number, value: number): string => {
      const text = axes[axis]?.values[value] ?? '';
      return text.includes('=') || !/^[\d.]/.test(text) ? text : `${axes[axis]!.name} ${text}`;
    };
    const corner = (span: number): HTMLElement[] =>
      rows < 0 ? [] : [h('th', { scope: 'col', class: 'corner', rowspan: span }, axes[rows]!.name)];
    const head = h('thead');
    if (group >= 0)
      head.append(h('tr', { class: 'groups' }, ...corner(2),
        ...groups.map((g) => h('th', { scope: 'colgroup', colspan: columns.length }, name(group, g)))));
    head.append(h('tr', { class: 'columns' }, ...(group >= 0 ? [] : corner(1)),
      ...groups.flatMap((_, g) => columns.map((c, i) => h('th', { scope: 'col', class: g > 0 && i === 0 ? 'first' : undefined }, name(cols, c))))));
    const body = h('tbody', {}, ...values(rows).map((row) => h('tr', {},
      ...(rows < 0 ? [] : [h('th', { scope: 'row' }, name(rows, row))]),
      ...groups.flatMap((g, index) => columns.map((c, i) => {
        const there = byPlace.get(`${row} ${g} ${c}`) ?? [];
        return h('td', { class: index > 0 && i === 0 ? 'first' : undefined }, ...there.map((cell) => this.cell(cell).element));
      })))));
    const count = groups.length * columns.length;
    const table = h('table', { class: count > 12 ? 'grid wide' : 'grid', 'aria-labelledby': id },
      h('colgroup', {}, rows < 0 ? null : h('col', { class: 'heads' }), ...Array.from({ length: count }, () => h('col'))), head, body);
    // All cells have one size, no larger than useful. If they would get too small, the section scrolls.
    table.style.width = `min(100%, ${8 + 11.7 * count}rem)`;
    table.style.setProperty('--columns', String(count));
    return h('section', { class: 'grid-section', 'aria-labelledby': id }, h('h2', { id }, label), table);
  }
}
