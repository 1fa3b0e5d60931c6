// A table for each section, and lists; each draws the rows in view alone.
import { h } from '../lib/dom';
import { Live, type Block, type Window } from './scroller';

/** In pixels. */
export interface Sizes {
  readonly rem: number;
  readonly width: number;  // of the box
  readonly isHeat: boolean;
  readonly aspect: number;  // the tallest picture's height by its width
  readonly beside: number;  // pictures of a cell
}
export type MakeCell = (cell: number) => HTMLElement;

const kFoot = 1.75;  // rem: the bar of the metric, the mark and the value
const kHeatHeight = 1.9;

export interface Section {
  readonly id: string;
  readonly label: string;
  readonly corner: string;
  /** Empty if there is no such axis. */
  readonly rowNames: readonly string[];
  readonly groupNames: readonly string[];
  readonly columnNames: readonly string[];
  cellAt(row: number, group: number, column: number): number;
}

export class TableBlock implements Block {
  readonly height: number;
  readonly width: number;
  private readonly count: number;
  private readonly rowCount: number;
  private readonly heads: number;  // width of the heads of rows
  private readonly cellWidth: number;
  private readonly rowHeight: number;
  private readonly titleHeight: number;
  private readonly headHeights: readonly number[];
  private rows: Live | undefined;
  private columns: Live | undefined;
  private readonly cellsOf = new Map<number, Live>();

  constructor(private readonly of: Section, private readonly sizes: Sizes, private readonly makeCell: MakeCell) {
    const { rem, width, isHeat } = sizes, groups = Math.max(1, of.groupNames.length);
    this.count = groups * of.columnNames.length;
    this.rowCount = Math.max(1, of.rowNames.length);
    this.heads = of.rowNames.length === 0 ? 0 : (width < 40 * rem ? 5.5 : 8) * rem;
    const [least, most] = isHeat ? [2.4, 6] : [4.3, 11.7];
    this.cellWidth = Math.floor(Math.min(most * rem, Math.max(least * rem, (width - this.heads) / this.count)));
    this.rowHeight = Math.ceil(isHeat ? kHeatHeight * rem : (this.cellWidth - 0.7 * rem) * sizes.aspect + (0.7 + kFoot) * rem);
    this.titleHeight = 3 * rem;
    const column = (this.cellWidth < 5.5 * rem ? 3.4 : 2.6) * rem;
    this.headHeights = of.groupNames.length > 0 ? [2 * rem, column] : [column];
    this.width = Math.max(width, this.heads + this.count * this.cellWidth);
    this.height = this.titleHeight + this.headHeights.reduce((p, q) => p + q) + this.rowCount * this.rowHeight + rem;
  }

  make(): HTMLElement {
    const { of } = this;
    const line = (kind: string, index: number): HTMLElement => {
      const row = h('tr', { role: 'row', class: kind, 'aria-rowindex': index + 1 });
      row.style.height = `${this.headHeights[index]}px`;
      const corner = index === 0 ? h('th', { role: 'columnheader', class: 'corner' }, of.corner) : h('td', { role: 'cell', class: 'corner' });
      if (this.heads > 0) row.append(this.sized(corner));
      return row;
    };
    const head = h('thead', { role: 'rowgroup' }), body = h('tbody', { role: 'rowgroup' });
    if (of.groupNames.length > 0) {
      const row = line('groups', 0), each = of.columnNames.length * this.cellWidth;
      of.groupNames.forEach((name, group) => row.append(this.placed(
        h('th', { role: 'columnheader', 'aria-colspan': of.columnNames.length, title: name }, name), group * each, each)));
      head.append(row);
    }
    const columns = line('columns', this.headHeights.length - 1);
    head.append(columns);
    body.style.height = `${this.rowCount * this.rowHeight}px`;
    this.columns = new Live(columns);
    this.rows = new Live(body);
    this.cellsOf.clear();
    const title = h('h2', { id: of.id }, of.label);
    title.style.maxWidth = `${this.sizes.width}px`;
    return h('section', { class: 'grid-section', 'aria-labelledby': of.id }, title,
      h('table', { role: 'table', class: this.count > 12 ? 'grid wide' : 'grid', 'aria-labelledby': of.id,
        'aria-rowcount': this.rowCount + this.headHeights.length, 'aria-colcount': this.count + (this.heads > 0 ? 1 : 0)}, head, body));
  }

  draw(at: Window): void {
    const top = this.titleHeight + this.headHeights.reduce((p, q) => p + q);
    const part = (from: number, to: number, size: number, count: number, more: number): [number, number] =>
      [Math.max(0, Math.floor(from / size) - more), Math.min(count, Math.ceil(to / size) + more)];
    const [row, lastRow] = part(at.top - top, at.bottom - top, this.rowHeight, this.rowCount, at.spare);
    const [cell, lastCell] = part(at.left - this.heads, at.right - this.heads, this.cellWidth, this.count, 4 * at.spare);
    this.columns!.keep(cell, lastCell, (i) => this.columnHead(i));
    this.rows!.keep(row, lastRow, (i) => this.row(i));
    for (const [i, cells] of this.cellsOf) {
      if (!this.rows!.has(i)) this.cellsOf.delete(i);
      else cells.keep(cell, lastCell, (c) => this.place(i, c));
    }
  }

  private row(index: number): HTMLElement {
    const row = h('tr', { role: 'row', 'aria-rowindex': index + 1 + this.headHeights.length });
    row.style.top = `${index * this.rowHeight}px`;
    row.style.height = `${this.rowHeight}px`;
    const name = this.of.rowNames[index];
    if (name !== undefined) row.append(this.sized(h('th', { role: 'rowheader', title: name }, h('span', {}, name))));
    this.cellsOf.set(index, new Live(row));
    return row;
  }

  private columnHead(index: number): HTMLElement {
    const name = this.of.columnNames[index % this.of.columnNames.length]!;
    return this.placed(h('th', { role: 'columnheader', class: this.isFirst(index) ? 'first' : undefined, title: name, 'aria-colindex': this.columnIndex(index) }, name),
      index * this.cellWidth, this.cellWidth);
  }

  private place(row: number, index: number): HTMLElement {
    const columns = this.of.columnNames.length, cell = this.of.cellAt(row, Math.floor(index / columns), index % columns);
    return this.placed(h('td', { role: 'cell', class: this.isFirst(index) ? 'first' : undefined, 'aria-colindex': this.columnIndex(index) },
      cell < 0 ? null : this.makeCell(cell)), index * this.cellWidth, this.cellWidth);
  }

  private columnIndex(index: number): number { return index + (this.heads > 0 ? 2 : 1); }

  private isFirst(index: number): boolean { return index > 0 && this.of.groupNames.length > 0 && index % this.of.columnNames.length === 0; }

  private sized(head: HTMLElement): HTMLElement {
    head.style.width = `${this.heads}px`;
    return head;
  }

  private placed(element: HTMLElement, left: number, width: number): HTMLElement {
    element.style.left = `${this.heads + left}px`;
    element.style.width = `${width}px`;
    return element;
  }
}

export class ListBlock implements Block {
  readonly height: number;
  readonly width: number;
  private readonly across: number;
  private readonly itemWidth: number;
  private readonly itemHeight: number;
  private readonly titleHeight: number;
  private items: Live | undefined;

  constructor(private readonly cells: ArrayLike<number>, private readonly title: string, private readonly isOfPairs: boolean,
              private readonly sizes: Sizes, private readonly makeItem: MakeCell) {
    const { rem, width, isHeat, beside } = sizes, least = (isOfPairs ? 30 : 8.5) * rem;
    this.across = Math.max(1, Math.floor((width + rem) / (least + rem)));
    this.itemWidth = (width - rem * (this.across - 1)) / this.across;
    const picture = isHeat ? kHeatHeight * rem : Math.min((isOfPairs ? 12 : 10) * rem, this.itemWidth / beside) * sizes.aspect;
    this.itemHeight = Math.ceil(picture + (kFoot + (isOfPairs ? 8 : 4.6)) * rem);
    this.titleHeight = (title ? 3.5 : 1) * rem;
    this.width = width;
    this.height = this.titleHeight + Math.ceil(cells.length / this.across) * this.itemHeight;
  }

  make(): HTMLElement {
    const list = h('ul', { class: this.isOfPairs ? 'cell-list of-pairs' : 'cell-list' });
    this.items = new Live(list);
    return h('div', { class: 'grid-section' }, this.title ? h('h2', {}, this.title) : null, list);
  }

  draw(at: Window): void {
    const from = Math.max(0, Math.floor((at.top - this.titleHeight) / this.itemHeight)) * this.across;
    const to = Math.min(this.cells.length, Math.ceil((at.bottom - this.titleHeight) / this.itemHeight) * this.across);
    this.items!.keep(from, to, (index) => {
      const item = h('li', { 'aria-setsize': this.cells.length, 'aria-posinset': index + 1 }, this.makeItem(this.cells[index]!));
      item.style.left = `${(index % this.across) * (this.itemWidth + this.sizes.rem)}px`;
      item.style.top = `${Math.floor(index / this.across) * this.itemHeight}px`;
      item.style.width = `${this.itemWidth}px`;
      item.style.height = `${this.itemHeight}px`;
      return item;
    });
  }
}
