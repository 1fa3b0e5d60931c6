// What gallery/cell_json.cpp writes for a cell's page.
import type { RecordNumber } from '../lib/numbers';
import type { DifferenceMap } from './maps';

/** `small` is shorter to load where `src` is heavy, and `src` elsewhere; both are drawn at this size. */
export interface PictureFile { readonly src: string; readonly small: string; readonly width: number; readonly height: number }

export interface Engine {
  readonly name: string;
  readonly title: string;
  readonly shortTitle: string;
  readonly picture: PictureFile | null;
  readonly floatScript: string | null;
}

export interface Comparison {
  readonly a: string;
  readonly b: string;
  readonly picture: PictureFile | null;
  readonly whiteAt: RecordNumber;
  readonly relativeToPeak: RecordNumber;
  readonly maps: readonly DifferenceMap[];
  /** The pixel of the largest difference. */
  readonly worstX: RecordNumber;
  readonly worstY: RecordNumber;
}

export interface Profile {
  readonly angle: string;
  readonly degrees: readonly RecordNumber[];
  readonly zones: readonly { readonly title: string; readonly from: RecordNumber; readonly to: RecordNumber }[];
  readonly curves: readonly { readonly name: string; readonly values: readonly RecordNumber[] }[];
}

export interface CellData {
  readonly id: string;
  readonly label: string;
  readonly exposureStops: RecordNumber;
  readonly engines: readonly Engine[];
  readonly comparisons: readonly Comparison[];
  readonly profile: Profile | null;
}
