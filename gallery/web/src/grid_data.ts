// What gallery/grid_json.cpp writes for the grid's page.
import type { RecordNumber } from './lib/numbers';

export interface GridAxis { readonly name: string; readonly values: readonly string[] }

export interface GridMetric {
  readonly id: string;
  readonly title: string;
  readonly meaning: string;
  readonly unit: 'radiance' | 'share' | 'count' | 'plain';
  readonly moreIsBetter: boolean;
}

export interface GridCell {
  readonly id: string;
  readonly label: string;
  readonly href: string;
  readonly status: string;
  /** Its value on each axis; -1 where the axis does not know it. */
  readonly at: readonly number[];
  /** Of each engine, a value of each metric. */
  readonly metrics: Readonly<Record<string, readonly RecordNumber[]>>;
  readonly picture?: { readonly src: string; readonly width: number; readonly height: number };
}

export interface GridStatus { readonly name: string; readonly word: string; readonly mark: string }

export interface GridData {
  readonly axes: readonly GridAxis[];
  readonly engines: readonly { readonly name: string; readonly title: string; readonly shortTitle: string }[];
  readonly metrics: readonly GridMetric[];
  readonly statuses: readonly GridStatus[];
  /** The order without script: -1 where there is no such axis. */
  readonly layout: { readonly rows: number; readonly groups: number; readonly columns: number };
  readonly cells: readonly GridCell[];
}
