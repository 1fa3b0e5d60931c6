// What the program gives the pages' scripts. Written by `lobelia records --typescript > gallery/web/src/records.ts`;
// do not edit: records/pages.cpp has the tables.

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

/** A cell's thumbnail. */
export interface GridPicture {
  src: string;
  width: number;
  height: number;
}

/** A cell of the grid. */
export interface GridCell {
  id: string;
  label: string;
  href: string;
  status: string;
  /** its value on each axis; -1 where the axis does not know it */
  at: number[];
  /** by engine, a value of each metric */
  metrics: Record<string, (number | "nan" | "inf" | "-inf" | null)[]>;
  picture?: GridPicture;
  /** of a report: the other pictures, each followed by its difference */
  beside?: GridPicture[];
  /** of a report: a sentence */
  finding?: string;
}

/** A metric that a grid can be coloured by. */
export interface GridMetric {
  id: string;
  title: string;
  meaning: string;
  unit: "radiance" | "share" | "count" | "plain";
  moreIsBetter: boolean;
}

/** The page of the grid. */
export interface GridPage {
  /** what a cell is called */
  noun: string;
  axes: GridAxis[];
  engines: GridEngine[];
  layout: GridLayout;
  statuses: GridStatus[];
  cells: GridCell[];
  metrics: GridMetric[];
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
}

/** A difference for each pixel. */
export interface ShownMap {
  id: string;
  title: string;
  meaning: string;
  /** of a PackedPicture */
  script: string;
}

/** A comparison of two engines' pictures. */
export interface ShownComparison {
  a: string;
  b: string;
  /** of the difference */
  picture: ShownPicture | null;
  whiteAt: number | "nan" | "inf" | "-inf" | null;
  relativeToPeak: number | null;
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

/** The largest errors of a lobe: of the peak, and in ulp. */
export interface StabilitySummary {
  group: string;
  lobe: string;
  exponent: number;
  naive: [number | "nan" | "inf" | "-inf", number | "nan" | "inf" | "-inf"];
  ours: [number | "nan" | "inf" | "-inf", number | "nan" | "inf" | "-inf"];
}

/** One highlight along a line across it, of the peak. */
export interface StabilityCurve {
  exponent: number;
  model: string;
  lobe: string;
  /** degrees */
  degrees: number[];
  truth: (number | "nan" | "inf" | "-inf")[];
  naive: (number | "nan" | "inf" | "-inf")[];
  ours: (number | "nan" | "inf" | "-inf")[];
}

/** The page of the hard cases. */
export interface StabilityPage {
  summaries: StabilitySummary[];
  curves: StabilityCurve[];
}

/** An axis of a chart. */
export interface ChartAxis {
  /** with its unit */
  label: string;
  from: number;
  to: number;
  logarithmic?: boolean;
  /** labelled values */
  ticks?: number[];
}

/** A marked range of the x axis. */
export interface ChartBand {
  title: string;
  from: number;
  to: number;
}

/** A line. A value that is not finite is a gap. */
export interface ChartSeries {
  name: string;
  /** 0 is a broad pale line, 1 to 5 are dash patterns */
  style: number;
  x: (number | "nan" | "inf" | "-inf")[];
  y: (number | "nan" | "inf" | "-inf")[];
}

/** A chart and the claims that it shows. */
export interface PaperFigure {
  id: string;
  title: string;
  description: string;
  x: ChartAxis;
  y: ChartAxis;
  bands: ChartBand[];
  series: ChartSeries[];
  claims: string[];
}

/** The page of the paper's claims. */
export interface PaperPage {
  charts: PaperFigure[];
}

/** How far an interpolated value may be off: of the peak for a curve, else relative. */
export interface TableErrors {
  curve: number;
  albedo: number;
  halfWidth: number;
  coefficient: number;
}

/** A model, for the explorer. */
export interface ModelTable {
  name: string;
  title: string;
  angle: string;
  appliesCosine: boolean;
  hasShadowing: boolean;
  normalised: string;
  coefficient: string;
}

/** A lobe over the exponents. docs/decisions/0015 defines the tables. */
export interface LobeTable {
  name: string;
  title: string;
  formula: string;
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
}
