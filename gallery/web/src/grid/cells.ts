// The cells as lists of numbers: a farm has up to 150 000, each with a hundred figures.
import { load } from '../lib/data';
import { numberText, percentText } from '../lib/numbers';
import type { GridChange, GridColumns, GridMetric, GridPage, GridPicture, GridStatus } from '../records';

/** The page lists statuses by how bad they are. The first few say that a file is not as the farm wrote it. */
const kFlaws = 3;
/** In place of an engine: the worst of all engines. */
export const kAll = '*';

/** A metric of an engine, or the worst of all engines, for every cell. NaN: there is none. */
export interface Values {
  readonly metric: GridMetric;
  readonly values: Float32Array;
  readonly limits: Float32Array;
}

function unpacked(text: string): Float32Array {
  return new Float32Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
}

/** How many times over its limit a value is; NaN without a limit. */
export function timesOver({ moreIsBetter }: GridMetric, value: number, limit: number): number {
  if (moreIsBetter) return limit < 1 ? (1 - value) / (1 - limit) : value < limit ? Infinity : 1;
  return limit > 0 ? Math.abs(value) / limit : limit === 0 ? (value === 0 ? 0 : Infinity) : NaN;
}

export function metricText(metric: GridMetric, value: number): string {
  return metric.unit === 'share' ? percentText(value) : metric.unit === 'count' ? numberText(value, 9) : numberText(value);
}

const lessBad = ({ moreIsBetter }: GridMetric, p: number, q: number): boolean => moreIsBetter ? q < p : Math.abs(q) > Math.abs(p);

export class Cells {
  readonly count: number;
  private readonly loaded = new Map<number, { engine: string; values: Float32Array; limits: Float32Array }[]>();
  private readonly values = new Map<string, Values>();
  private readonly ownLabels: Map<number, string>;
  private ids: string[] | undefined;
  private readonly labelTexts: string[][];

  constructor(readonly page: GridPage) {
    this.count = page.ids.length;
    this.labelTexts = page.axes.map(({ name, values }) => values.map((label) => (/^[0-9]/.test(label) ? `${name} ${label}` : label).toLowerCase()));
    this.ownLabels = new Map((page.labels ?? []).map(({ cell, label }) => [cell, label]));
    for (const columns of page.columns ?? []) this.take(columns);
  }

  at(cell: number, axis: number): number { return this.page.at[cell * this.page.axes.length + axis]!; }

  status(cell: number): GridStatus { return this.page.statuses[this.page.status[cell]!]!; }

  /** Since an earlier run, if the page was made with one. */
  change(cell: number): GridChange | undefined { return this.page.changes?.[this.page.change?.[cell] ?? -1]; }

  isFlaw(cell: number): boolean { return this.page.status[cell]! < kFlaws; }

  /** As gallery/cells/shown_farm.cpp has it. */
  label(cell: number): string {
    const own = this.ownLabels.get(cell);
    return own ?? this.page.axes.map(({ name, values }, axis) => {
      const label = values[this.at(cell, axis)]!;
      return /^[0-9]/.test(label) ? `${name} ${label}` : label;
    }).join(' · ');
  }

  folder(cell: number): string { return `cells/${encodeURIComponent(this.page.ids[cell]!)}/`; }

  address(cell: number): string {
    return this.page.place ? 'cell.html#cell=' + encodeURIComponent(this.page.ids[cell]!) : this.folder(cell) + 'index.html';
  }

  pictures(cell: number): (GridPicture | undefined)[] {
    return [this.page.picture[cell]!, ...(this.page.beside?.[cell] ?? [])].map((place) => this.page.pictures[place]);
  }

  /** Whether a word in small letters is in a cell's label, id or status. A large grid has few labels and many cells. */
  has(word: string): (cell: number) => boolean {
    const { page: { axes, at, status, statuses } } = this, ids = this.ids ??= this.page.ids.map((id) => id.toLowerCase());
    const inLabel = this.labelTexts.map((labels) => labels.map((label) => label.includes(word)));
    const inStatus = statuses.map((s) => s.word.toLowerCase().includes(word));
    const inOwn = new Map([...this.ownLabels].map(([cell, label]) => [cell, label.toLowerCase().includes(word)]));
    return (cell) => {
      const own = inOwn.get(cell);
      if (own === undefined)
        for (let axis = 0, i = cell * axes.length; axis < axes.length; ++axis, ++i) if (inLabel[axis]![at[i]!]) return true;
      return own === true || inStatus[status[cell]!]! || ids[cell]!.includes(word);
    };
  }

  isLoaded(metric: number): boolean { return this.loaded.has(metric); }

  async fetch(metric: number): Promise<void> {
    if (!this.isLoaded(metric)) this.take(await load<GridColumns>(`grid.${metric}`, `grid.${metric}.data.js`));
  }

  private take(columns: GridColumns): void {
    this.loaded.set(columns.metric, columns.engines.map(({ engine, values, limits }) => {
      const own = unpacked(limits);
      return { engine: this.page.engines[engine]!.name, values: unpacked(values),
        limits: own.length === this.count ? own : new Float32Array(this.count).fill(own[0] ?? NaN) };
    }));
  }

  /** Undefined until the metric is fetched, or if the engine has none. */
  valuesOf(engine: string, metric: number): Values | undefined {
    const key = `${metric} ${engine}`, known = this.values.get(key);
    if (known) return known;
    const about = this.page.metrics[metric]!;
    const columns = (this.loaded.get(metric) ?? []).filter((c) => engine === kAll || c.engine === engine);
    if (columns.length === 0) return undefined;
    const values = Float32Array.from(columns[0]!.values), limits = Float32Array.from(columns[0]!.limits);
    for (const other of columns.slice(1)) {
      for (let i = 0; i < this.count; ++i) {
        const there = other.values[i]!, over = timesOver(about, values[i]!, limits[i]!), otherOver = timesOver(about, there, other.limits[i]!);
        const isWorse = otherOver > over || (!(otherOver < over) && lessBad(about, values[i]!, there));
        if (!Number.isNaN(there) && (Number.isNaN(values[i]) || isWorse)) { values[i] = there; limits[i] = other.limits[i]!; }
      }
    }
    const made = { metric: about, values, limits };
    this.values.set(key, made);
    return made;
  }
}
