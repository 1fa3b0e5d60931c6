// The grid: any two axes as rows and columns, coloured by any metric, filtered, failures first.
import { Cells, kAll, metricText, type Values } from '../grid/cells';
import { ListBlock, TableBlock, type Sizes } from '../grid/blocks';
import { query } from '../grid/query';
import { Scale } from '../grid/scale';
import { Scroller, type Block } from '../grid/scroller';
import { Thumbnails } from '../grid/thumbnails';
import { pageData } from '../lib/data';
import { announce, button, h, isTyping, select } from '../lib/dom';
import { pageAt, pictureAt } from '../lib/single_file';
import { HashState } from '../lib/state';
import type { GridPage } from '../records';

const kNone = '-1';
const kMostMade = 1000;  // elements of cells, kept

export function grid(main: HTMLElement): void {
  const data = pageData<GridPage>(), place = main.querySelector<HTMLElement>('#grid');
  if (data && place && data.ids.length > 0) new GridView(place, data);
}

const sentence = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

type AxisKey = 'rows' | 'cols' | 'group';
type Select = ReturnType<typeof select>;

class GridView {
  private readonly cells: Cells;
  private readonly state;
  private readonly scroller: Scroller;
  private readonly none = h('p', { class: 'absent', hidden: true });
  private readonly count = h('output', { class: 'count' });
  private readonly legend = h('div', { class: 'legend-bar' });
  private readonly find = h('input', { type: 'search', placeholder: 'blinn n = 128', id: 'find', 'aria-keyshortcuts': '/',
    title: 'Words, and conditions: n = 16, exponent > 100, exponent = 16..128, ssim < 0.99, change = worse (/)' });
  private readonly axes: Record<AxisKey, Select>;
  private readonly thumbnails = new Thumbnails();
  private readonly choices: Record<'metric' | 'engine' | 'status' | 'change' | 'order' | 'show', Select>;
  private readonly unreadable = new Set<number>();
  private readonly made = new Map<number, HTMLElement>();
  private look = '';
  private readonly scales = new Map<Values, Scale>();
  private values: Values | undefined;
  private scale: Scale | undefined;
  private width = 0;
  private rem = 0;

  constructor(place: HTMLElement, private readonly data: GridPage) {
    this.cells = new Cells(data);
    this.scroller = new Scroller(sentence(data.noun) + 's');
    const { rows, groups, columns } = data.layout;
    const main = data.metrics.find((m) => m.id === 'max_rel_peak') ?? data.metrics[0];
    const engine = data.engines.length > 1 ? kAll : data.engines[0]?.name;
    this.state = new HashState({
      rows: String(rows), cols: String(columns), group: String(groups), find: '', status: '', change: '', order: this.isReport() || this.isList() ? 'worst' : 'grid',
      colour: main && engine ? `${engine}/${main.id}` : 'status', show: 'pictures',
    });
    const named = data.axes.map((axis, i) => ({ value: String(i), label: axis.name }));
    const axis = (label: string, key: AxisKey): Select =>
      select(label, key === 'cols' ? named : [...named, { value: kNone, label: 'none' }], '', (value) => this.takeAxis(key, value));
    this.axes = { rows: axis('Rows', 'rows'), cols: axis('Columns', 'cols'), group: axis('Grouped by', 'group') };
    const metrics = main ? [main, ...data.metrics.filter((m) => m !== main)] : [];
    const engines = data.engines.map((e) => ({ value: e.name, label: e.shortTitle }));
    const used = new Set(data.status);
    this.choices = {
      metric: select('Metric', [...metrics.map((m) => ({ value: m.id, label: m.title })), { value: 'status', label: 'none: status alone' }], '',
        (id) => this.change({ colour: id === 'status' ? id : `${this.colour()?.engine ?? engine ?? ''}/${id}` })),
      engine: select('Engine', data.engines.length > 1 ? [{ value: kAll, label: 'worst of all' }, ...engines] : engines, '',
        (name) => this.change({ colour: `${name}/${data.metrics[this.colour()?.metric ?? 0]?.id ?? ''}` })),
      status: select('Status', [{ value: '', label: 'any' }, ...data.statuses.filter((_, i) => used.has(i)).map((s) => ({ value: s.name, label: s.word }))], '',
        (status) => this.change({ status })),
      change: select('Change', [{ value: '', label: 'any' }, ...(data.changes ?? []).filter((_, i) => data.change?.includes(i)).map((c) => ({ value: c.name, label: c.word }))], '',
        (change) => this.change({ change })),
      order: select('Order', [{ value: 'grid', label: this.isList() ? 'by name' : 'the grid' }, { value: 'worst', label: 'failures first' },
        { value: 'most', label: 'metric, largest first' }, { value: 'least', label: 'metric, smallest first' }], '', (order) => this.change({ order })),
      show: select('Show', [{ value: 'pictures', label: 'pictures' }, { value: 'heat', label: 'heat map' }], '', (show) => this.change({ show })),
    };
    this.find.addEventListener('input', () => this.change({ find: this.find.value }));
    const { metric, engine: by, status, change, order, show } = this.choices;
    place.replaceChildren(h('div', { class: 'grid-bar', role: 'search', 'aria-label': 'The grid' },
      h('label', {}, h('span', {}, 'Find'), this.find), status.element, ...(data.changes ? [change.element] : []), order.element, ...(metrics.length > 0 ? [metric.element, by.element] : []), show.element,
      this.isList() ? null : h('div', { class: 'axes-choice' }, this.axes.rows.element,
        button('⇄', () => this.takeAxis('rows', this.state.get('cols')),
          { 'aria-label': 'Exchange rows and columns', title: 'Exchange rows and columns (x)', 'aria-keyshortcuts': 'x' }),
        this.axes.cols.element, ...(data.axes.length > 2 ? [this.axes.group.element] : [])),
      this.count, this.legend), this.none, this.scroller.box);
    this.state.onChange(() => this.refresh());
    document.addEventListener('keydown', (event) => this.key(event));
    this.refresh();
    this.keepPlace();
    new ResizeObserver(() => { const { clientWidth } = this.scroller.box; if (clientWidth > 0 && clientWidth !== this.width) { this.width = clientWidth; this.rem = 0; this.refresh(); } }).observe(this.scroller.box);
  }

  /** Who comes back from a cell's page is where they were. */
  private keepPlace(): void {
    const { box } = this.scroller, before = (history.state as { grid?: [number, number] } | null)?.grid;
    if (before) box.scrollTo(before[1], before[0]);
    addEventListener('pagehide', () => history.replaceState({ grid: [box.scrollTop, box.scrollLeft] }, ''));
  }

  private isReport(): boolean { return this.data.noun !== 'cell'; }

  /** One axis, too long for a line. */
  private isList(): boolean { return this.data.layout.columns < 0; }

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

  /** "*\/ssim" in the link: the engine and the metric that colour the cells. */
  private colour(): { engine: string; metric: number } | undefined {
    const text = this.state.get('colour'), slash = text.indexOf('/'), engine = text.slice(0, slash);
    const metric = this.data.metrics.findIndex((m) => m.id === text.slice(slash + 1));
    const isKnown = engine === kAll || this.data.engines.some((e) => e.name === engine);
    return slash > 0 && metric >= 0 && isKnown ? { engine, metric } : undefined;
  }

  private order(): string {
    const order = this.state.get('order');
    return ['worst', 'most', 'least'].includes(order) ? order : 'grid';
  }

  private refresh(): void {
    const { state, cells, data } = this, colour = this.colour(), { metric, engine, status, order, show } = this.choices;
    if (this.find.value !== state.get('find')) this.find.value = state.get('find');
    for (const key of ['rows', 'cols', 'group'] as const) this.axes[key].set(String(this.axis(key)));
    const wanted = data.statuses.findIndex((s) => s.name === state.get('status'));
    metric.set(colour ? data.metrics[colour.metric]!.id : 'status');
    engine.set(colour?.engine ?? kAll);
    status.set(wanted >= 0 ? state.get('status') : '');
    const changed = (data.changes ?? []).findIndex((c, i) => c.name === state.get('change') && data.change?.includes(i));
    this.choices.change.set(changed >= 0 ? state.get('change') : '');
    order.set(this.order());
    show.set(this.isHeat() ? 'heat' : 'pictures');
    const found = query(cells, state.get('find'), (m) => cells.valuesOf(colour?.engine ?? kAll, m));
    this.fetch([...(colour ? [colour.metric] : []), ...found.metrics]);
    this.values = colour && cells.valuesOf(colour.engine, colour.metric);
    if (this.values && !this.scales.has(this.values)) this.scales.set(this.values, new Scale(this.values));
    this.scale = this.values && this.scales.get(this.values);
    this.legend.replaceChildren(...(this.scale?.legend() ?? []));
    const shown: number[] = [];
    for (let i = 0; i < cells.count; ++i)
      if ((wanted < 0 || data.status[i] === wanted) && (changed < 0 || data.change![i] === changed) && found.tests.every((test) => test(i))) shown.push(i);
    const text = `showing ${shown.length} of ${cells.count} ${data.noun}s`;
    if (this.count.textContent && this.count.textContent !== text) announce(text);
    this.count.textContent = text;
    this.none.textContent = `No ${data.noun} is like that.`;
    this.none.hidden = shown.length > 0;
    this.scroller.box.hidden = shown.length === 0;
    // Asking for it makes the browser lay out the page.
    this.width ||= this.scroller.box.clientWidth;
    this.scroller.show(shown.length === 0 ? [] : this.order() !== 'grid' || this.isList() ? [this.list(this.sorted(shown))] : this.sections(shown));
  }

  private fetch(metrics: readonly number[]): void {
    const missing = metrics.filter((m) => !this.cells.isLoaded(m) && !this.unreadable.has(m));
    if (missing.length === 0) return;
    void Promise.all(missing.map((m) => this.cells.fetch(m).catch(() => { this.unreadable.add(m); }))).then(() => this.refresh());
  }

  private isHeat(): boolean { return this.state.get('show') === 'heat'; }

  private sizes(): Sizes {
    const shapes = this.data.pictures.map(({ width, height }) => height / width);
    return { rem: this.rem ||= parseFloat(getComputedStyle(document.documentElement).fontSize), width: this.width, isHeat: this.isHeat(),
      aspect: Math.min(2, Math.max(0, ...shapes) || 1), beside: 1 + Math.max(0, ...(this.data.beside ?? []).slice(0, 1000).map((b) => b.length)) };
  }

  // ---- cells

  /** As it was made before, while its colours are the same: most of the time of Find would be for making them. */
  private cell(cell: number): HTMLElement {
    const look = `${this.state.get('colour')} ${this.state.get('show')} ${this.values !== undefined}`;
    if (look !== this.look || this.made.size > kMostMade) { this.made.clear(); this.look = look; }
    const known = this.made.get(cell) ?? this.makeCell(cell);
    this.made.set(cell, known);
    return known;
  }

  private makeCell(cell: number): HTMLElement {
    const { cells, values, scale } = this, status = cells.status(cell), name = cells.label(cell) || this.data.ids[cell]!;
    const value = values ? metricText(values.metric, values.values[cell]!) : '';
    const change = cells.change(cell), isChanged = change && change.name !== 'same';
    const words = `${name}: ${status.word}${isChanged ? `, ${change.word}` : ''}`, href = pageAt(cells.address(cell));
    const mark = h('span', { 'aria-hidden': 'true' }, status.mark);
    const arrow = isChanged ? h('span', { class: `change ${change.name}`, title: change.word, 'aria-hidden': 'true' }, change.mark) : null;
    const hasValue = scale !== undefined && !Number.isNaN(values!.values[cell]);
    if (this.isHeat()) {
      const link = h('a', { href, title: value ? `${words}, ${value}` : words, 'aria-label': value ? `${words}, ${value}` : words }, mark, arrow);
      if (hasValue) {
        link.style.background = scale.colour(cell);
        link.classList.toggle('over', scale.isOver(cell));
      }
      return h('div', { class: `cell heat ${status.name}` }, link);
    }
    const [first, ...beside] = cells.pictures(cell).map((one) => one && { ...one, src: pictureAt(cells.folder(cell) + one.file) });
    const image = ({ src, width, height }: NonNullable<typeof first>, alt: string): HTMLImageElement => {
      const place = this.data.place?.[cell];
      const made = h('img', { loading: 'lazy', decoding: 'async', alt, width, height, src: place === undefined ? src : undefined });
      if (place !== undefined) this.thumbnails.paint(made, place);
      return made;
    };
    const swatch = h('span', { class: 'swatch', hidden: !hasValue });
    if (hasValue) scale.paint(swatch, cell);
    return h('div', { class: `cell ${status.name}` },
      h('a', { href, title: words, class: this.data.beside ? 'pictures-beside' : undefined },
        first ? image(first, words) : h('span', { class: 'no-picture' }, 'no picture', h('span', { class: 'unseen' }, ', ' + words)),
        ...beside.map((one) => (one ? image(one, '') : null)), swatch),
      h('span', { class: 'cell-foot' }, h('span', { class: `status ${status.name}`, title: status.word }, mark,
        h('span', { class: cells.isFlaw(cell) ? 'word' : 'unseen' }, status.word)), arrow, isChanged ? h('span', { class: 'unseen' }, change.word) : null, h('span', { class: 'value' }, value)));
  }

  private item(cell: number): HTMLElement {
    const { cells } = this, label = cells.label(cell) || this.data.ids[cell]!, finding = this.data.findings?.[cell];
    return h('div', {}, this.cell(cell), h('a', { href: pageAt(cells.address(cell)), class: 'cell-name', title: label }, label),
      finding ? h('p', { class: 'finding', title: finding }, finding) : null);
  }

  private sorted(shown: readonly number[]): readonly number[] {
    const { cells, scale } = this, order = this.order(), isLess = order === 'least' || (order === 'worst' && this.values?.metric.moreIsBetter);
    // A report has its pairs in an order of its own: by how far the worst figure is over its limit.
    if (this.isReport() && this.isList() && order === 'worst' && this.state.get('colour') === this.state.defaults.colour) return shown;
    const all = Array.from(shown);
    if (order === 'grid') {
      const labels = new Map(all.map((cell) => [cell, cells.label(cell)]));
      return all.sort((p, q) => (labels.get(p)! < labels.get(q)! ? -1 : 1));
    }
    const keys = Float64Array.from({ length: cells.count }, (_, i) => {
      const size = scale?.size(i) ?? NaN;
      return Number.isNaN(size) ? Infinity : isLess ? size : -size;
    });
    return all.sort((p, q) => (order === 'worst' ? this.data.status[p]! - this.data.status[q]! : 0) || (keys[p] === keys[q] ? p - q : keys[p]! - keys[q]!));
  }

  private list(shown: ArrayLike<number>, title = ''): Block {
    return new ListBlock(shown, title, this.isReport(), this.sizes(), (cell) => this.item(cell));
  }

  /** The axes span at most 200 000 places (gallery/pages/grid_layout.cpp). */
  private sections(shown: readonly number[]): Block[] {
    const { cells, data } = this, { axes } = data, rows = this.axis('rows'), group = this.axis('group'), cols = this.axis('cols');
    const size = (axis: number): number => (axis < 0 ? 1 : axes[axis]!.values.length);
    const rest = axes.map((_, i) => i).filter((i) => ![rows, cols, group].includes(i)), inner = [rows, group, cols].filter((i) => i >= 0);
    const order = [...rest, ...inner], sizesOf = order.map(size), { at } = data;
    const cellAt = new Int32Array(sizesOf.reduce((product, n) => product * n, 1)).fill(-1), homeless: number[] = [];
    for (const cell of shown) {
      let place = 0;
      for (let i = 0; i < order.length; ++i) {
        const value = at[cell * order.length + order[i]!]!;
        place = value < 0 ? NaN : place * sizesOf[i]! + value;
      }
      if (cellAt[place] === -1) cellAt[place] = cell; else homeless.push(cell);
    }
    const name = (axis: number, value: number): string => {
      const text = axes[axis]!.values[value] ?? '';
      return text.includes('=') || !/^[\d.]/.test(text) ? text : `${axes[axis]!.name} ${text}`;
    };
    const names = (axis: number, values: readonly number[]): string[] => (axis < 0 ? [] : values.map((value) => name(axis, value)));
    const sizes = this.sizes(), span = size(rows) * size(group) * size(cols), blocks: Block[] = [];
    for (let start = 0; start < cellAt.length; start += span) {
      const used = [rows, group, cols].map((axis) => new Uint8Array(size(axis)));
      let any = -1;
      for (let row = 0, i = start; row < used[0]!.length; ++row)
        for (let g = 0; g < used[1]!.length; ++g)
          for (let column = 0; column < used[2]!.length; ++column, ++i)
            if (cellAt[i]! >= 0) { any = cellAt[i]!; used[0]![row] = used[1]![g] = used[2]![column] = 1; }
      if (any < 0) continue;
      const [r, g, c] = used.map((flags) => [...flags.keys()].filter((i) => flags[i])) as [number[], number[], number[]];
      const label = rest.map((axis) => `${axes[axis]!.name}: ${axes[axis]!.values[cells.at(any, axis)]}`).join(' · ');
      blocks.push(new TableBlock({ id: `grid-${blocks.length + 1}`, label: sentence(label) || 'The grid', corner: axes[rows]?.name ?? '',
        rowNames: names(rows, r), groupNames: names(group, g), columnNames: names(cols, c),
        cellAt: (row, at, column) => cellAt[start + (r[row]! * size(group) + g[at]!) * size(cols) + c[column]!]! }, sizes, (cell) => this.cell(cell)));
    }
    if (homeless.length > 0) blocks.push(this.list(homeless, 'Cells that have no place on the axes'));
    return blocks;
  }
}
