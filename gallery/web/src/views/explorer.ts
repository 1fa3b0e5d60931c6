// One highlight, or two over each other: sphere, curve, coefficient, peak, width, energy and cost at any exponent.
import { kOwnState, OwnShader } from '../explorer/own_shader';
import { kSphereState, SphereView } from '../explorer/sphere_view';
import { AtExponent } from '../explorer/tables';
import { Chart, rangeOf, type Series } from '../lib/chart';
import { pageData } from '../lib/data';
import { announce, button, h, select } from '../lib/dom';
import { saveFile } from '../lib/figure';
import { clamp, numberText } from '../lib/numbers';
import { HashState } from '../lib/state';
import type { ExplorerPage, HighlightTable, HighlightTables, LobeTable, ModelTable, Operations } from '../records';

type Field = 'lobe' | 'model' | 'norm' | 'n';
type Key = Field | `${Field}2` | 'two' | 'scale' | 'unit' | keyof typeof kSphereState | keyof typeof kOwnState;
const kSides = [{ suffix: '', name: 'A' }, { suffix: '2', name: 'B' }] as const;
const kDecades = 6;  // below the peak on a logarithmic axis

interface Chosen {
  readonly name: string; readonly lobe: LobeTable; readonly model: ModelTable; readonly highlight: HighlightTable;
  readonly norm: string; readonly at: AtExponent; readonly shader: string;
}

/** "3 × +, 12 ×, 1 ÷; price 21": of the lobe and the model together. */
function operationsText(lobe: Operations, model: Operations): string {
  const signs: [keyof Operations, string][] = [['multiplyAdd', '× +'], ['multiply', '×'], ['add', '+'], ['divide', '÷'], ['root', '√'], ['transcendental', 'exp or log'], ['compare', 'comparisons']];
  return signs.flatMap(([key, sign]) => (lobe[key] + model[key] ? `${lobe[key] + model[key]} ${sign}` : [])).join(', ') + `; price ${lobe.price + model.price}`;
}

export function explorer(main: HTMLElement): void {
  const data = pageData<ExplorerPage>(), place = main.querySelector('#explorer');
  if (data && place) new Explorer(data.tables, data.search ?? '', place);
}

class Explorer {
  private readonly state;
  private readonly curves = new Chart('The highlight over the angle', 400, () => this.about('curve'));
  private readonly energy = new Chart('Energy over incidence', 400, () => this.about('energy'));
  private readonly numbers = h('tbody');
  private readonly heads = h('tr');
  private readonly panels: { refresh(): void; element: HTMLElement }[];
  private readonly two = h('input', { type: 'checkbox', id: 'two' });
  private readonly scale;
  private readonly unit;
  private readonly own;
  private readonly sphere;
  private readonly note = h('p', { class: 'stage-note' });

  constructor(private readonly tables: HighlightTables, search: string, place: Element) {
    const middle = tables.exponents.includes(64) ? '64' : String(tables.exponents[0]);
    const model = tables.models[1]?.name ?? '', lobe = tables.lobes[0]?.name ?? '';
    const other = tables.lobes.find((l) => l.name === 'cs16')?.name ?? lobe;
    this.state = new HashState<Key>({
      lobe, model, norm: 'exact', n: middle, lobe2: other, model2: model, norm2: 'exact', n2: middle,
      two: '1', scale: 'linear', unit: 'radiance', ...kSphereState, ...kOwnState,
    });
    const titleOf = (c: Chosen): string => `${c.model.title}, ${c.lobe.title}, n = ${numberText(c.at.n, 4)}`;
    this.own = new OwnShader(this.state, search, () => {
      const a = this.chosen(kSides[0]);
      return a && { model: a.model.name, lobe: a.lobe.name, normalisation: a.norm, exponent: a.at.n, title: titleOf(a) };
    }, () => this.refresh());
    this.sphere = new SphereView(this.state, () => (this.own.isShown ? [...this.shown().slice(0, 1).map(titleOf), 'your shader'] : this.shown().map(titleOf)), this.own);
    this.panels = kSides.map((side) => this.panel(side));
    this.two.addEventListener('change', () => this.change({ two: this.two.checked ? '1' : '0' }));
    this.scale = select('Scale', [{ value: 'linear', label: 'linear' }, { value: 'log', label: 'logarithmic' }], 'linear',
      (scale) => this.change({ scale }), 'explorer-scale');
    this.unit = select('Values', [{ value: 'radiance', label: 'radiance' }, { value: 'peak', label: 'of the peak' }], 'radiance',
      (unit) => this.change({ unit }), 'explorer-unit');
    place.append(h('section', { class: 'explorer', 'aria-label': 'Explorer' },
      h('div', { class: 'choices' }, ...this.panels.map((p) => p.element), this.own.element),
      h('div', { class: 'figure-grid' }, this.sphere.element,
        h('figure', { class: 'chart-figure' }, h('h2', {}, 'The highlight'),
          h('div', { class: 'controls' }, this.scale.element, this.unit.element), this.curves.element,
          h('figcaption', {}, 'Radiance per unit irradiance where N·L = 1: coefficient times lobe.')),
        h('figure', { class: 'chart-figure' }, h('h2', {}, 'Energy over incidence'), this.note, this.energy.element,
          h('figcaption', {}, 'Seen: towards an eye under a sky of radiance 1. Lit: what leaves of a beam. Above 1 the model ' +
            'makes light. They are one where light and eye are treated alike.')),
      h('div', { class: 'table-wrap', tabindex: 0, role: 'region', 'aria-label': 'The numbers' },
        h('table', { class: 'figures explorer-numbers' }, h('thead', {}, this.heads), this.numbers)))));
    this.state.onChange(() => this.refresh());
    this.refresh();
  }

  private change(changes: Partial<Record<Key, string>>): void {
    this.state.set(changes);
    this.refresh();
  }

  /** From the link, within the range of the tables. */
  private exponent(key: 'n' | 'n2'): number {
    const { exponents } = this.tables;
    return clamp(this.state.number(key), exponents[0]!, exponents.at(-1)!);
  }

  private chosen(side: (typeof kSides)[number]): Chosen | undefined {
    const { lobes, models, highlights } = this.tables, key = (field: Field) => this.state.get(`${field}${side.suffix}`);
    const lobe = lobes.find((l) => l.name === key('lobe')) ?? lobes[0], model = models.find((m) => m.name === key('model')) ?? models[0];
    const highlight = highlights.find((x) => x.lobe === lobe?.name && x.model === model?.name);
    if (!lobe || !model || !highlight) return undefined;
    const norm = key('norm') === 'paper' && highlight.paper ? 'paper' : 'exact';
    const shader = ((norm === 'paper' && highlight.paperShader) || highlight.shader).map((part) => this.tables.shaderParts[part]).join('');
    return { name: side.name, lobe, model, highlight, norm, shader, at: new AtExponent(this.tables, this.exponent(`n${side.suffix}`)) };
  }

  private panel(side: (typeof kSides)[number]): { refresh(): void; element: HTMLElement } {
    const { lobes, models, exponents } = this.tables, { suffix, name } = side;
    const lobe = select('Lobe', lobes.map((l) => ({ value: l.name, label: l.title })), '', (v) => this.change({ [`lobe${suffix}`]: v }), `lobe${suffix}`);
    const model = select('Model', models.map((m) => ({ value: m.name, label: m.title })), '', (v) => this.change({ [`model${suffix}`]: v }), `model${suffix}`);
    const norm = select('Normalisation', [{ value: 'exact', label: 'exact' }, { value: 'paper', label: 'as the paper prints it' }], '',
      (v) => this.change({ [`norm${suffix}`]: v }), `norm${suffix}`);
    const first = exponents[0]!, last = exponents.at(-1)!;
    const slider = h('input', { type: 'range', min: Math.log2(first), max: Math.log2(last), step: 0.01, id: `slide${suffix}`,
      'aria-label': `Exponent ${name}` });
    const number = h('input', { type: 'number', min: first, max: last, step: 'any', id: `n${suffix}` });
    slider.addEventListener('input', () => this.change({ [`n${suffix}`]: String(Number((2 ** Number(slider.value)).toPrecision(3))) }));
    number.addEventListener('change', () => {
      this.change({ [`n${suffix}`]: number.value });
      number.value = String(this.exponent(`n${suffix}`));
    });
    const formula = h('p', { class: 'formula' });
    const text = h('pre', { tabindex: 0 }), shader = h('details', {}, h('summary', {}, 'Shader (GLSL)'), text);
    const copy = button('Copy shader', () => {
      navigator.clipboard?.writeText(text.textContent ?? '').then(() => announce('The shader is copied.'), () => { shader.open = true; });
    }, { 'aria-label': `Copy shader ${name}` });
    const save = button('Save float picture', () => {
      const picture = this.sphere.pfm(suffix ? 1 : 0), chosen = this.chosen(side);
      if (picture) saveFile(`${chosen?.model.name}-${chosen?.lobe.name}-${chosen?.at.n}.pfm`, picture);
    }, { 'aria-label': `Save float picture ${name}` });
    const body = h('div', { class: 'choice-body' }, lobe.element, model.element, norm.element,
      h('div', { class: 'exponent' }, h('label', { for: `n${suffix}` }, 'Exponent n'), slider, number), formula,
      h('div', { class: 'controls' }, copy, save), shader);
    const element = h('fieldset', { class: `choice choice-${name}` },
      h('legend', {}, suffix ? h('label', {}, this.two, ' B, laid over it') : 'A'), body);
    const refresh = (): void => {
      const chosen = this.chosen(side), on = !suffix || this.state.get('two') === '1';
      if (!chosen) return;
      lobe.set(chosen.lobe.name);
      model.set(chosen.model.name);
      norm.set(chosen.norm);
      for (const option of norm.element.querySelectorAll('option')) option.disabled = option.value === 'paper' && !chosen.highlight.paper;
      for (const input of body.querySelectorAll<HTMLInputElement | HTMLSelectElement | HTMLButtonElement>('input, select, button')) input.disabled = !on;
      slider.value = String(Math.log2(chosen.at.n));
      slider.setAttribute('aria-valuetext', numberText(chosen.at.n, 4));
      if (document.activeElement !== number) number.value = String(chosen.at.n);
      text.textContent = chosen.shader;
      const asked = [this.state.get(`lobe${suffix}`), this.state.get(`model${suffix}`)];
      const missing = asked.filter((name) => name !== chosen.lobe.name && name !== chosen.model.name).map((name) => `“${name}” is not in the tables. `);
      formula.textContent = `${missing.join('')}${chosen.lobe.formula}, s = 1 − cos of the angle between ${chosen.model.angle}`;
    };
    return { refresh, element };
  }

  private shown(): Chosen[] {
    return kSides.slice(0, this.state.get('two') === '1' ? 2 : 1).flatMap((side) => this.chosen(side) ?? []);
  }

  private about(what: string): { name: string; caption: string } {
    const shown = this.shown();
    return {
      name: [what, ...shown.map((c) => `${c.model.name}-${c.lobe.name}-n${numberText(c.at.n, 4)}`)].join('-'),
      caption: shown.map((c) => `${c.name}: ${c.model.title}, ${c.lobe.title}, n = ${numberText(c.at.n, 4)}, ${c.norm === 'paper' ? 'as the paper prints it' : 'exact'}`).join('; '),
    };
  }

  private refresh(): void {
    const both = this.state.get('two') === '1';
    this.two.checked = both;
    this.scale.set(this.state.get('scale'));
    this.unit.set(this.state.get('unit'));
    for (const panel of this.panels) panel.refresh();
    const shown = this.shown();
    this.own.refresh();
    this.sphere.refresh(shown.map((c) => ({
      model: c.model, n: c.at.n, shader: c.shader, coefficient: c.at.coefficient(c.highlight, c.norm),
    })));
    this.drawCurves(shown);
    this.drawEnergy(shown);
    this.fillNumbers(shown);
  }

  private drawCurves(shown: readonly Chosen[]): void {
    const logarithmic = this.state.get('scale') === 'log', ofPeak = this.state.get('unit') === 'peak';
    const least = logarithmic ? 10 ** -kDecades : 1e-3;
    let end = 0, peak = 0;
    const series: Series[] = shown.map((c, i) => {
      const curve = c.at.curve(c.lobe), times = ofPeak ? 1 : c.at.coefficient(c.highlight, c.norm);
      const last = curve.y.findIndex((v) => v < least);
      end = Math.max(end, curve.x[last < 0 ? curve.x.length - 1 : last]!);
      peak = Math.max(peak, times);
      return { name: `${c.name} ${c.lobe.title}`, x: curve.x, y: curve.y.map((v) => v * times), style: 1 + i };
    });
    const angles = new Set(shown.map((c) => c.model.angle));
    const decade = Math.ceil(Math.log10(peak));
    const y = logarithmic ? { from: 10 ** (decade - kDecades), to: 10 ** decade } : { from: 0, to: rangeOf([0, peak], false).to };
    this.curves.update({
      x: { label: `angle between ${[...angles].join(' (A), ')}${angles.size > 1 ? ' (B)' : ''}, degrees`, from: 0, to: Math.min(90, end) || 90 },
      y: { label: ofPeak ? 'of the peak' : 'radiance per unit irradiance', ...y, logarithmic },
      // Values below the chart are neither drawn nor shown.
      series: logarithmic ? series.map((s) => ({ ...s, y: s.y.map((v) => (v < y.from / 2 ? NaN : v)) })) : series,
    });
  }

  private drawEnergy(shown: readonly Chosen[]): void {
    const series: Series[] = shown.flatMap((c, i) => {
      const seen = { ...c.at.albedo(c.highlight, c.norm, false), style: 1 + i };
      if (!c.highlight.lit) return [{ name: `${c.name} seen and lit`, ...seen }];
      return [{ name: `${c.name} seen`, ...seen }, { name: `${c.name} lit`, ...c.at.albedo(c.highlight, c.norm, true), style: 3 + i }];
    });
    const most = Math.max(1, ...series.flatMap((s) => s.y));
    this.note.textContent = most > 2.5 ? `Up to ${numberText(most)} at 89.99°, beyond the chart.` : '';
    this.energy.update({
      x: { label: 'incidence (degrees)', from: 0, to: 90 }, y: { label: 'share reflected', from: 0, to: Math.min(2.5, Math.max(1.2, most * 1.05)) },
      series, level: 1,
    });
  }

  private fillNumbers(shown: readonly Chosen[]): void {
    const rows: [string, (c: Chosen) => string][] = [
      ['Exponent n', (c) => numberText(c.at.n, 5)],
      ['Coefficient, of the radiance', (c) => numberText(c.at.coefficient(c.highlight, c.norm), 4)],
      ['Normalisation constant', (c) => (c.norm === 'paper' ? 'as the paper prints it' : c.model.normalisationConstant) + (c.model.normalised === 'radiance' ? '' : ', four times the coefficient')],
      ['Peak', (c) => `${numberText(c.at.coefficient(c.highlight, c.norm), 4)}${c.model.hasShadowing ? ' G / N·V' : c.model.appliesCosine ? ' N·L' : ' at any incidence'}`],
      ['Half-width of the lobe', (c) => `${numberText(c.at.halfWidth(c.lobe), 4)}°`],
      ['Lobe is 0 beyond', (c) => `${numberText(c.at.reach(c.lobe), 4)}°`],
      ['Operations a point', (c) => operationsText(c.lobe.operations, c.model.operations)],
      ['Energy at normal incidence', (c) => numberText(c.at.albedo(c.highlight, c.norm, false).y[0]!, 4)],
      ['Most seen', (c) => numberText(Math.max(...c.at.albedo(c.highlight, c.norm, false).y), 4)],
      ['Most of a beam', (c) => numberText(Math.max(...c.at.albedo(c.highlight, c.norm, true).y), 4)],
    ];
    this.heads.replaceChildren(h('td'), ...shown.map((c) => h('th', { scope: 'col' }, `${c.name}: ${c.lobe.title}, ${c.model.title}`)));
    this.numbers.replaceChildren(...rows.map(([title, text]) =>
      h('tr', {}, h('th', { scope: 'row' }, title), ...shown.map((c) => h('td', { class: 'number' }, text(c))))));
  }
}
