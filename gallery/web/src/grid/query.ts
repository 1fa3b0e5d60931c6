// Parses Find: words, and conditions such as n = 16, exponent > 100, exponent = 16..128, ssim < 0.99, max_rel_peak > 1%.
import type { Cells, Values } from './cells';

const kTerm = /("[^"]*"|[^\s<>=!"]+)\s*(>=|<=|!=|=|>|<)\s*("[^"]*"|[^\s<>=!"]+)|\S+/g;
const kUnfinished = /("[^"]*"|[^\s<>=!"]+)\s*(>=|<=|!=|=|>|<|!)\s*$/;  // while it is typed
const kNumber = /[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?/i;

type Test = (cell: number) => boolean;

const plain = (text: string): string => text.replace(/"/g, '').toLowerCase();

/** "n = 128" is 128, "45°" is 45. */
export function numberIn(label: string): number {
  const found = kNumber.exec(label.slice(label.indexOf('=') + 1));
  return found ? Number(found[0]) : NaN;
}

/** A number, "1%", or NaN where it is neither. */
function numberOf(text: string): number {
  const found = /^([^%]+)(%?)$/.exec(text);
  return found && found[1]!.trim() !== '' ? Number(found[1]) * (found[2] ? 0.01 : 1) : NaN;
}

function compares(operator: string, wanted: string): (value: number) => boolean {
  const [from, to] = wanted.split('..').map(numberOf);
  if (to !== undefined && operator === '=') return (value) => value >= from! && value <= to;
  const limit = from!;
  // A value on the page is a float32, so "= 0.1" is not to be asked of it to the last bit.
  const isSame = (value: number): boolean => Math.abs(value - limit) <= 1e-6 * Math.abs(limit);
  switch (operator) {
    case '=': return isSame;
    case '!=': return (value) => !isSame(value);
    case '>': return (value) => value > limit && !isSame(value);
    case '<': return (value) => value < limit && !isSame(value);
    case '>=': return (value) => value >= limit || isSame(value);
    default: return (value) => value <= limit || isSame(value);
  }
}

/** The axis by its name, by the beginning of it, or by what stands before "=" in its labels. */
function axisCalled(cells: Cells, name: string): number {
  const { axes } = cells.page, places = axes.map((_, i) => i);
  return places.find((i) => axes[i]!.name.toLowerCase() === name)
    ?? places.find((i) => axes[i]!.values.some((v) => v.includes('=') && plain(v.split('=')[0]!).trim() === name))
    ?? places.find((i) => axes[i]!.name.toLowerCase().startsWith(name)) ?? -1;
}

export function metricCalled(cells: Cells, name: string): number {
  const { metrics } = cells.page, exact = metrics.findIndex((m) => m.id.toLowerCase() === name);
  return exact >= 0 ? exact : metrics.findIndex((m) => m.title.toLowerCase().startsWith(name));
}

/** The metrics that have to be fetched, and the test as far as they are there. */
export function query(cells: Cells, text: string, valuesOf: (metric: number) => Values | undefined): { metrics: number[]; tests: Test[] } {
  const metrics: number[] = [], tests: Test[] = [];
  for (const term of text.replace(kUnfinished, '').matchAll(kTerm)) {
    const [whole, name = '', operator = '', wanted = ''] = term;
    const axis = operator ? axisCalled(cells, plain(name)) : -1, metric = operator && axis < 0 ? metricCalled(cells, plain(name)) : -1;
    const accepts = compares(operator, plain(wanted));
    if (axis >= 0) {
      const isNumber = !Number.isNaN(numberOf(plain(wanted).split('..')[0]!));
      const allowed = cells.page.axes[axis]!.values.map((label) => isNumber ? accepts(numberIn(label))
        : operator === '=' ? plain(label).includes(plain(wanted)) : operator === '!=' && !plain(label).includes(plain(wanted)));
      tests.push((cell) => allowed[cells.at(cell, axis)] ?? false);
    } else if (metric < 0 && plain(name) === 'change' && /^!?=$/.test(operator)) {
      tests.push((cell) => (cells.change(cell)?.name === plain(wanted)) === (operator === '='));
    } else if (metric >= 0) {
      metrics.push(metric);
      const of = valuesOf(metric);
      if (of) tests.push((cell) => accepts(of.metric.moreIsBetter ? of.values[cell]! : Math.abs(of.values[cell]!)));
    } else {
      for (const word of plain(whole).split(/\s+/).filter(Boolean)) tests.push(cells.has(word));
    }
  }
  return { metrics, tests };
}
