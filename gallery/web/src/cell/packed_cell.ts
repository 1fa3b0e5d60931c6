// Reads the cells that gallery/cells/cell_chunk.cpp packs.
import { load } from '../lib/data';
import { inflated } from '../lib/inflate';
import { toNumber } from '../lib/numbers';
import { PackedNumbers } from '../lib/packed_numbers';
import { PackedPixels } from '../lib/packed_pixels';
import type { CellChunk, CellIndex, CellPage, CellTexts, ShownProfile } from '../records';

export interface OpenedCell {
  readonly page: CellPage;
  readonly markup: string;
  /** Addresses by the names that the markup has. */
  readonly pictures: ReadonlyMap<string, string>;
}

/** As link_to() of gallery/pages/page.cpp has it: the files are in this order. */
const encoded = (id: string): string =>
  encodeURIComponent(id).replace(/[!'()*]/g, (c) => '%' + c.charCodeAt(0).toString(16).toUpperCase());

/** Undefined if there is no such cell. Throws an error for the reader. */
export async function openCell(index: CellIndex, id: string): Promise<OpenedCell | undefined> {
  const key = encoded(id), file = index.first.filter((first) => first <= key).length - 1;
  if (file < 0) return undefined;
  const source = `packed/${file}.cells.data.js`, chunk = await load<CellChunk>(`cells.${file}`, source);
  try {
    return await cellOf(chunk, id);
  } catch (error) {
    throw new Error(`${source} is damaged: ${error instanceof Error ? error.message : String(error)}`);
  }
}

/** Throws any error if the chunk is damaged. */
export async function cellOf(chunk: CellChunk, id: string): Promise<OpenedCell | undefined> {
  const texts = JSON.parse(new TextDecoder().decode(await inflated(chunk.texts))) as CellTexts;
  const place = texts.cells.findIndex((cell) => cell.id === id);
  if (place < 0) return undefined;
  const { page, main: markup, pictures: shown, counts } = texts.cells[place]!;
  const packed = new PackedPixels(shown, await inflated(chunk.pixels[place]!));
  const pictures = new Map(shown.map(({ file }, i) => [file, packed.address(i)]));
  if (page.profile) {
    const numbers = new PackedNumbers(await inflated(chunk.curves));
    for (const before of texts.cells.slice(0, place)) numbers.skip(before.counts.reduce((sum, n) => sum + n, 0));
    restoreCurves(page.profile, counts, numbers);
  }
  for (const { picture } of [...page.engines, ...page.comparisons])
    if (picture) picture.src = picture.small = pictures.get(picture.src) ?? '';
  return { page, markup, pictures };
}

function restoreCurves(profile: ShownProfile, counts: readonly number[], numbers: PackedNumbers): void {
  const { curves, fromFormula = [] } = profile;
  profile.degrees = numbers.next(counts[0]!, false);
  curves.forEach((curve, i) => { curve.values = numbers.next(counts[i + 1]!, fromFormula.includes(curve.name)); });
  const formula = curves.find((c) => c.name === 'analytic')?.values ?? [];
  for (const curve of curves)
    if (fromFormula.includes(curve.name)) curve.values = curve.values.map((value, i) => toNumber(formula[i]) + toNumber(value));
}
