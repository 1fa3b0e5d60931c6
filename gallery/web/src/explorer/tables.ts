// Interpolates the tables of gallery/pages/explorer_page.cpp (docs/records.md, highlight-tables) over the exponent. Knows no
// formula of a lobe or a model.
import type { HighlightTable, HighlightTables, LobeTable } from '../records';

export interface Curve { readonly x: number[]; readonly y: number[] }

const kDegree = Math.PI / 180, kFiner = 4;

/** Four times as many points, by the cubic through the four nearest, for a smooth line. */
function refined(values: readonly number[]): number[] {
  const last = values.length - 1, result: number[] = [];
  for (let i = 0; i <= last * kFiner; ++i) {
    const at = i / kFiner, first = Math.max(0, Math.min(last - 3, Math.floor(at) - 1));
    if (i % kFiner === 0 || last < 3) { result.push(values[Math.round(at)]!); continue; }
    let sum = 0;
    for (let j = 0; j < 4; ++j) {
      let weight = 1;
      for (let k = 0; k < 4; ++k) if (k !== j) weight *= (at - first - k) / (j - k);
      sum += weight * values[first + j]!;
    }
    result.push(sum);
  }
  return result;
}

/** Angles from 0 to `reach`, closer together where a highlight is bright. */
function spread(reach: number, n: number, count: number): number[] {
  const most = Math.asinh(reach * Math.sqrt(n));
  return Array.from({ length: count }, (_, i) => reach * Math.sinh(most * i / (count - 1)) / Math.sinh(most));
}

/** The tables at one exponent. */
export class AtExponent {
  private readonly first: number;
  private readonly weights: number[];

  constructor(private readonly tables: HighlightTables, readonly n: number) {
    const { exponents, perOctave } = tables;
    const octaves = (exponents.length - 1) / perOctave;
    const at = Math.log2(n / exponents[0]!), octave = Math.max(0, Math.min(octaves - 1, Math.floor(at)));
    this.first = octave * perOctave;
    const u = (at - octave) * perOctave, places = Array.from({ length: perOctave + 1 }, (_, i) => i);
    this.weights = places.map((i) => places.reduce((w, k) => (k === i ? w : w * (u - k) / (i - k)), 1));
  }

  private number(values: readonly number[]): number {
    return Math.exp(this.weights.reduce((sum, w, i) => sum + w * Math.log(values[this.first + i]!), 0));
  }

  private row(rows: readonly (readonly number[])[]): number[] {
    const first = rows[this.first]!;
    return first.map((_, j) => this.weights.reduce((sum, w, i) => sum + w * rows[this.first + i]![j]!, 0));
  }

  /** Degrees at which the lobe has fallen to half. */
  halfWidth(lobe: LobeTable): number { return this.number(lobe.halfWidth) / kDegree; }
  /** Degrees beyond which the lobe is 0. */
  reach(lobe: LobeTable): number { return this.number(lobe.reach) / kDegree; }

  /** The lobe over its angle in degrees; 1 at 0. */
  curve(lobe: LobeTable): Curve {
    const numbers = this.row(lobe.curves);
    return {
      x: spread(this.number(lobe.reach), this.n, numbers.length).map((a) => a / kDegree),
      y: numbers.map((v) => (lobe.order > 0 ? Math.max(0, v * lobe.unit) ** lobe.order : Math.exp(v * lobe.unit))),
    };
  }

  coefficient(highlight: HighlightTable, normalisation: string): number {
    return this.number((normalisation === 'paper' && highlight.paper) || highlight.exact);
  }

  /** The albedo over incidence in degrees: seen under a uniform sky, or (`lit`) the share of a beam that leaves. */
  albedo(highlight: HighlightTable, normalisation: string, lit: boolean): Curve {
    const values = refined(this.row((lit && highlight.lit) || highlight.seen));
    const times = this.coefficient(highlight, normalisation) / this.coefficient(highlight, 'exact');
    const grazing = this.tables.mostGrazing, x = spread(grazing, this.n, values.length).map((a) => grazing - a);
    // The table for `lit` lacks the factor 1/(N.L), which has no bound.
    const y = values.map((v, i) => times * Math.exp(v * highlight.unit) / (lit && highlight.lit ? Math.cos(x[i]!) : 1));
    return { x: x.map((a) => a / kDegree).reverse(), y: y.reverse() };
  }
}
