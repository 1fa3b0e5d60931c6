// The curves of a highlight: radiance, ratio to the formula, or difference from it.
import { Chart, rangeOf, type Series } from '../lib/chart';
import { h, select } from '../lib/dom';
import { toNumber } from '../lib/numbers';
import type { HashState } from '../lib/state';
import type { CellPage, ShownProfile } from '../records';

const kScales = [
  { value: 'linear', label: 'Radiance, linear' },
  { value: 'log', label: 'Radiance, logarithmic' },
  { value: 'ratio', label: 'Ratio to the formula' },
  { value: 'error', label: 'Difference from the formula, logarithmic' },
] as const;
const kFormula = 'analytic';

function curves(data: CellPage, profile: ShownProfile): Series[] {
  const x = profile.degrees.map(toNumber);
  const order = [kFormula, ...data.engines.map((e) => e.name).filter((name) => name !== kFormula)];
  return order.flatMap((name) => {
    const curve = profile.curves.find((c) => c.name === name);
    if (!curve) return [];
    const engine = data.engines.findIndex((e) => e.name === name);
    return [{
      name: name === kFormula ? 'formula' : data.engines[engine]?.shortTitle ?? name,
      x, y: curve.values.map(toNumber), style: name === kFormula ? 0 : 1 + engine % 5,
    }];
  });
}

export function profileView(data: CellPage, state: HashState<'scale'>): HTMLElement | undefined {
  const profile = data.profile;
  if (!profile || profile.degrees.length === 0) return undefined;
  const all = curves(data, profile);
  const formula = all.find((s) => s.style === 0);
  const choices = kScales.filter((s) => formula || (s.value !== 'ratio' && s.value !== 'error'));
  const chart = new Chart('The highlight as a curve', 380, () => ({
    name: `profile-${state.get('scale')}`, caption: `${data.label || data.id}: ${all.map((s) => s.name).join(', ')}`,
  }));
  const box = select('Show', choices, 'linear', (value) => { state.set({ scale: value }); draw(); }, 'profile-scale');

  const limit = Math.max(0, ...profile.zones.map((z) => z.to)) * 1.25 || 180;
  const end = Math.min(limit, Math.max(...all.flatMap((s) => s.x.filter((v) => v <= 180)), 1));
  const xAxis = {
    label: profile.angle.includes('half') ? 'angle between normal and half vector (degrees)'
      : 'angle between light and mirror direction (degrees)', from: 0, to: end,
  };

  function draw(): void {
    const scale = choices.find((c) => c.value === state.get('scale'))?.value ?? 'linear';
    box.set(scale);
    let series = all, label = 'radiance (linear light)';
    const logarithmic = scale === 'log' || scale === 'error';
    if (formula && (scale === 'ratio' || scale === 'error')) {
      const beside = (v: number, truth: number): number => (scale === 'error' ? Math.abs(v - truth) : truth ? v / truth : NaN);
      series = all.filter((s) => s !== formula).map((s) => ({ ...s, y: s.y.map((v, i) => beside(v, formula.y[i]!)) }));
      label = scale === 'ratio' ? 'engine / formula' : '|engine − formula| (radiance)';
    }
    const inView = series.flatMap((s) => s.y.filter((_, i) => s.x[i]! <= end));
    let range = rangeOf(scale === 'linear' ? [0, ...inView] : inView, logarithmic);
    if (scale === 'ratio') {
      // Around 1, wide enough for where there is light: at the lobe's very end a ratio says nothing.
      const peak = Math.max(...(formula?.y ?? [1]).filter(Number.isFinite));
      const lit = series.flatMap((s) => s.y.filter((v, i) => Number.isFinite(v) && (formula?.y[i] ?? 0) > 1e-3 * peak));
      const off = Math.max(1e-6, ...lit.map((v) => Math.abs(v - 1))) * 1.1;
      range = { from: 1 - off, to: 1 + off };
    }
    chart.update({
      x: xAxis, y: { label, ...range, logarithmic }, series, bands: profile!.zones, level: scale === 'ratio' ? 1 : undefined,
    });
  }
  state.onChange(draw);
  draw();
  return h('figure', { class: 'chart-figure scripted-only' },
    h('div', { class: 'controls' }, box.element), chart.element,
    h('figcaption', {}, 'Mean radiance (of red, green and blue) of the pixels at each angle, per engine; ' +
      'zones are shaded. The formula is broad and pale, below the others.'));
}
