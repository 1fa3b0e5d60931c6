// The program's data for the pages' scripts. Written by `lobelia records --typescript > gallery/web/src/records.ts`;
// do not edit: base/records/pages.cpp has the tables.

/** An axis of the grid. */
export interface GridAxis {
  name: string;
  /** labels */
  values: string[];
}

/** A reference engine that is there. */
export interface GridEngine {
  name: string;
  title: string;
  shortTitle: string;
}

/** The order without script; -1: no such axis. */
export interface GridLayout {
  rows: number;
  groups: number;
  columns: number;
}

/** A status that a cell may have. */
export interface GridStatus {
  name: string;
  word: string;
  mark: string;
}

/** A metric that a grid can be coloured by. */
export interface GridMetric {
  id: string;
  title: string;
  meaning: string;
  unit: "radiance" | "share" | "count" | "plain";
  moreIsBetter: boolean;
}

/** A thumbnail: many cells have one of the same name and size. */
export interface GridPicture {
  file: string;
  width: number;
  height: number;
}

/** The label of a cell that has no place on the axes. */
export interface GridLabel {
  cell: number;
  label: string;
}

/** How a cell may have changed since an earlier run. */
export interface GridChange {
  name: string;
  word: string;
  mark: string;
}

/** A metric of one engine. */
export interface GridColumn {
  /** its place in the list of engines */
  engine: number;
  /** a float32 for each cell, NaN where there is none; little endian, in base64 */
  values: string;
  /** likewise; one alone holds for every cell; may be empty */
  limits: string;
}

/** A metric of all engines. */
export interface GridColumns {
  /** its place in the list of metrics */
  metric: number;
  engines: GridColumn[];
}

/** The page of the grid. */
export interface GridPage {
  /** what a cell is called */
  noun: string;
  axes: GridAxis[];
  engines: GridEngine[];
  layout: GridLayout;
  statuses: GridStatus[];
  metrics: GridMetric[];
  pictures: GridPicture[];
  /** of the cells; the lists below are in their order */
  ids: string[];
  /** for each cell its value on each axis; -1 where the axis does not know it */
  at: number[];
  /** its place in the list of statuses */
  status: number[];
  /** its place in the list of pictures; -1: there is none */
  picture: number[];
  /** of a site in few files: its place among the thumbnails */
  place?: number[];
  /** where the values on the axes do not tell it */
  labels?: GridLabel[];
  /** of a report: the other pictures, each followed by its difference */
  beside?: number[][];
  /** of a report: a sentence, or nothing */
  findings?: string[];
  /** if there is an earlier run */
  changes?: GridChange[];
  /** its place in the list of changes */
  change?: number[];
  /** of a small grid; in a large one each is a file */
  columns?: GridColumns[];
}

/** A picture; both files are drawn at this size. */
export interface ShownPicture {
  src: string;
  /** shorter to load where src is heavy, else the same */
  small: string;
  width: number;
  height: number;
}

/** An engine and its picture of a cell. */
export interface ShownEngine {
  name: string;
  title: string;
  shortTitle: string;
  picture: ShownPicture | null;
  /** of a PackedPicture */
  floatScript: string | null;
  /** of an earlier run's picture: the engine's name */
  beforeOf?: string;
}

/** A difference for each pixel. */
export interface ShownMap {
  id: string;
  title: string;
  meaning: string;
  /** of a PackedPicture */
  script: string;
  /** of its scale */
  top: number;
}

/** A comparison of two engines' pictures. */
export interface ShownComparison {
  a: string;
  b: string;
  /** of the difference */
  picture: ShownPicture | null;
  whiteAt: number | "nan" | "inf" | "-inf" | null;
  maps: ShownMap[];
  /** pixel of the largest difference */
  worstX: number | "nan" | "inf" | "-inf" | null;
  worstY: number | "nan" | "inf" | "-inf" | null;
  /** script with the PixelRuns of the highlight */
  region?: string;
}

/** A zone of a highlight. */
export interface ShownZone {
  title: string;
  /** degrees */
  from: number;
  /** degrees */
  to: number;
}

/** A curve of a profile. */
export interface ShownCurve {
  /** of an engine, or analytic */
  name: string;
  values: (number | "nan" | "inf" | "-inf")[];
}

/** A highlight as curves. */
export interface ShownProfile {
  angle: string;
  degrees: (number | "nan" | "inf" | "-inf")[];
  zones: ShownZone[];
  /** each as long as degrees */
  curves: ShownCurve[];
  /** curves with differences from the formula as values */
  fromFormula?: string[];
}

/** The page of a cell. */
export interface CellPage {
  id: string;
  label: string;
  isReport: boolean;
  exposureStops: number | null;
  engines: ShownEngine[];
  comparisons: ShownComparison[];
  profile: ShownProfile | null;
}

/** A float picture in half floats, as text. */
export interface PackedPicture {
  width: number;
  height: number;
  /** it is the difference from our picture */
  fromOurs: boolean;
  /** pixels of the cell that one stands for, each way */
  block: number;
  scaleLog2: number;
  mantissaBits: number;
  /** what is smaller is 0 */
  least: number;
  predicted: boolean;
  /** base64, deflated */
  planes: string;
}

/** Pixels of a picture. */
export interface PixelRuns {
  width: number;
  height: number;
  /** for each run its first pixel in reading order, and its length */
  runs: number[];
}

/** A page of a report in one file. */
export interface InlinedPage {
  view: string;
  title: string;
  /** markup of its <main> */
  main: string;
}

/** The page of all cells. */
export interface CellIndex {
  /** the first id of each CellChunk, percent-encoded, in order */
  first: string[];
}

/** Neighbouring cells of a site in few files. */
export interface CellChunk {
  /** CellTexts; base64, deflated */
  texts: string;
  /** the numbers of all profiles as gallery/packed/packed_numbers.hpp has them; base64, deflated */
  curves: string;
  /** for each cell all its pictures as gallery/packed/packed_pixels.hpp has them; base64, deflated */
  pixels: string[];
}

/** An 8-bit picture, as a site in few files has it. */
export interface PackedShown {
  file: string;
  width: number;
  height: number;
  /** what its bytes are differences from: 1 a prediction from neighbours, 2 the first picture, 3 both */
  way: number;
}

/** A cell of a site in few files. */
export interface PackedCell {
  id: string;
  /** markup of its <main> */
  main: string;
  page: CellPage;
  pictures: PackedShown[];
  /** numbers of its profile's degrees and of each curve, which CellChunk has */
  counts: number[];
}

/** The texts of a CellChunk. */
export interface CellTexts {
  cells: PackedCell[];
}

/** Thumbnails of neighbouring cells. */
export interface Thumbnails {
  /** in pixels; 0 is no picture */
  widths: number[];
  heights: number[];
  /** as in PackedShown */
  ways: number[];
  /** all pictures as gallery/packed/packed_pixels.hpp has them; base64, deflated */
  pixels: string;
}

/** How far an interpolated value may be off: of the peak for a curve, else relative. */
export interface TableErrors {
  curve: number;
  albedo: number;
  halfWidth: number;
  coefficient: number;
}

/** Operations per point. What depends on the exponent alone is computed once. */
export interface Operations {
  multiplyAdd: number;
  multiply: number;
  add: number;
  divide: number;
  root: number;
  transcendental: number;
  /** comparisons, maxima and conversions */
  compare: number;
  /** of all, in multiplications of float32: a division counts as six */
  price: number;
}

/** A model, for the explorer. */
export interface ModelTable {
  name: string;
  title: string;
  angle: string;
  appliesCosine: boolean;
  hasShadowing: boolean;
  normalised: string;
  normalisationConstant: string;
  operations: Operations;
  sMax: number;
  /** 1 / coefficient is the integral of lobe(s) (w0 + w1 s + w2 s^2 + w3 s^3), s = 0 to sMax */
  weights: number[];
}

/** A lobe over the exponents. docs/records.md defines the tables. */
export interface LobeTable {
  name: string;
  title: string;
  formula: string;
  operations: Operations;
  order: number;
  /** curves are in multiples of it */
  unit: number;
  /** radians */
  reach: number[];
  /** radians */
  halfWidth: number[];
  curves: number[][];
}

/** A model with a lobe over the exponents. */
export interface HighlightTable {
  model: string;
  lobe: string;
  /** coefficients */
  exact: number[];
  /** coefficients; missing if the paper has none */
  paper?: number[];
  /** seen and lit are logarithms in multiples of it */
  unit: number;
  seen: number[][];
  /** missing if it is the same as seen */
  lit?: number[][];
  /** positions in shaderParts, which joined are the exported GLSL */
  shader: number[];
  /** with the paper's coefficient; missing if it has none */
  paperShader?: number[];
}

/** Every highlight over the exponent, as numbers that a page can interpolate. */
export interface HighlightTables {
  schemaVersion: 1;
  kind: "highlight-tables";
  madeBy: string;
  exponents: number[];
  perOctave: number;
  /** radians */
  mostGrazing: number;
  error: TableErrors;
  models: ModelTable[];
  lobes: LobeTable[];
  highlights: HighlightTable[];
  /** paragraphs of 'lobelia export --language glsl --coefficient argument' */
  shaderParts: string[];
}

/** The explorer's page. */
export interface ExplorerPage {
  tables: HighlightTables;
  /** studies/shader_check/web as WebAssembly; base64, deflated */
  search?: string;
}
