// The button "Figure": what it saves has the right bytes, and its panel can be used by keys.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { close, requireAccessible } from './browser.mjs';
import { cellSite } from './cell_site.mjs';
import { ours } from './farm.mjs';

const kSize = 16, { directory, cellPage } = cellSite({ size: kSize });
let textOf;

before(async () => {
  const source = path.join(path.dirname(fileURLToPath(import.meta.url)), '../src/lib/figure_text.ts'), outfile = path.join(directory, 'figure_text.mjs');
  await build({ entryPoints: [source], outfile, bundle: true, format: 'esm', logLevel: 'warning' });
  textOf = await import(pathToFileURL(outfile));
});

/** Presses a button of the open panel; the file's name and bytes. */
async function saved(page, button) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('dialog').getByRole('button', { name: button, exact: true }).click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** The picture's width and height, and the colours of some pixels. */
const decoded = (page, bytes, places) => page.evaluate(async ([data, at]) => {
  const image = new Image();
  image.src = 'data:image/png;base64,' + data;
  await image.decode();
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width: image.width, height: image.height });
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return { width: image.width, height: image.height, pixels: at.map(([x, y]) => [...context.getImageData(x * image.width, y < 0 ? image.height + y : y, 1, 1).data]) };
}, [bytes.toString('base64'), places]);

const parsed = (page, text) => page.evaluate((source) => {
  const file = new DOMParser().parseFromString(source, 'image/svg+xml');
  return { error: file.querySelector('parsererror')?.textContent ?? '', stops: file.querySelectorAll('stop').length, image: file.querySelector('image')?.getAttribute('href')?.slice(0, 22) ?? '',
    words: [...file.querySelectorAll('text')].map((t) => t.textContent), styled: file.querySelectorAll('[class], [style], style').length, paths: [...file.querySelectorAll('path')].map((p) => p.getAttribute('stroke')) };
}, text);

test('a difference is saved as a large picture with a colour bar, as numbers, and for LaTeX', async () => {
  const page = await cellPage('#a=lobelia&b=povray&mode=diff&z=fit');
  await page.getByRole('button', { name: 'Figure: what the viewer shows' }).click();
  await requireAccessible(page, 'the panel');
  const png = await saved(page, 'PNG');
  assert.equal(png.name, 'phong-16-povray-difference.png');
  const rows = (await saved(page, /^CSV/)).bytes.toString().trim().split('\n').map((line) => line.split(','));
  assert.deepEqual(rows[0], ['x', 'y', 'lobelia.r', 'lobelia.g', 'lobelia.b', 'povray.r', 'povray.g', 'povray.b', 'difference.r', 'difference.g', 'difference.b']);
  assert.equal(rows.length, 1 + kSize * kSize);
  const at = rows.find(([x, y]) => x === '7' && y === '8'), truth = ours(7, 8, kSize)[0];
  assert.ok(Math.abs(Number(at[2]) / truth - 1) < 1e-3, `${at[2]} is not ${truth}`);
  const svg = await saved(page, 'SVG'), drawing = await parsed(page, svg.bytes.toString());
  assert.equal(drawing.error, '');
  assert.ok(drawing.stops > 10 && drawing.image === 'data:image/png;base64,');
  assert.ok(drawing.words.some((words) => words.includes('radiance')), 'the bar has a unit');
  assert.ok(drawing.words.some((words) => /POV-Ray/.test(words)), 'the caption names the engines');
  assert.equal(drawing.styled, 0);
  // The bar goes from black to white below the picture: where, the SVG says.
  const bar = await page.evaluate((source) => {
    const file = new DOMParser().parseFromString(source, 'image/svg+xml'), rect = file.querySelector('rect[fill="url(#bar)"]');
    return { y: Number(rect.getAttribute('y')) + 9, x: Number(rect.getAttribute('x')), width: Number(rect.getAttribute('width')), all: Number(file.documentElement.getAttribute('width')) };
  }, svg.bytes.toString());
  const place = (share) => [(bar.x + share * bar.width) / bar.all, bar.y];
  const { width, pixels } = await decoded(page, png.bytes, [place(0.01), place(0.5), place(0.99)]);
  assert.ok(width >= 1000, `${width} pixels wide`);
  assert.ok(pixels[0][0] < 20 && Math.abs(pixels[1][0] - 128) < 8 && pixels[2][0] > 235, JSON.stringify(pixels));
  const tex = (await saved(page, 'LaTeX')).bytes.toString();
  assert.match(tex, /\\includegraphics\[width=\\linewidth\]\{phong-16-povray-difference\}/);
  assert.match(tex, /\\label\{fig:phong-16-povray-difference\}/);
  assert.equal(await page.getByRole('textbox', { name: 'Link' }).inputValue(), await page.evaluate(() => location.href));
  await close(page);
});

test('the panel opens and closes by keys, and its letters are no commands of the page', async () => {
  const page = await cellPage();
  const button = page.getByRole('button', { name: 'Figure: what the viewer shows' });
  await button.focus();
  await page.keyboard.press('Enter');
  await page.locator('dialog').waitFor();
  await page.keyboard.press('d');
  assert.equal(await page.evaluate(() => location.hash.includes('diff')), false);
  await page.keyboard.press('Escape');
  await page.locator('dialog').waitFor({ state: 'detached' });
  assert.equal(await button.evaluate((b) => b === document.activeElement), true);
  await close(page);
});

test('a chart is saved as an SVG that needs no page, with its legend, and as its series', async () => {
  const page = await cellPage('#line=0,8,15,8');
  await page.getByRole('button', { name: 'Figure: Values along the line' }).click();
  const svg = await saved(page, 'SVG'), drawing = await parsed(page, svg.bytes.toString());
  assert.equal(svg.name, 'phong-16-line.svg'.replace('phong-16', svg.name.replace(/-line\.svg$/, '')));
  assert.equal(drawing.error, '');
  assert.equal(drawing.styled, 0);
  assert.ok(drawing.words.includes('Lobelia') && drawing.words.includes('Values along the line'), drawing.words.join('; '));
  assert.ok(drawing.paths.length === 2 && drawing.paths.every((stroke) => /^#/.test(stroke ?? '')), String(drawing.paths));
  const rows = (await saved(page, /^CSV/)).bytes.toString().trim().split('\n');
  assert.equal(rows.length, 1 + kSize);
  assert.ok(Math.abs(Number(rows[8].split(',')[1]) / (ours(7, 8, kSize).reduce((a, b) => a + b) / 3) - 1) < 1e-3, rows[8]);
  const png = await saved(page, 'PNG');
  assert.ok((await decoded(page, png.bytes, [])).width >= 1000);
  await close(page);
});

test('captions are escaped for LaTeX, names for files, and formulas for spreadsheets', () => {
  const { csvText, fileName, latexText } = textOf;
  assert.equal(latexText('50 % of $x_1 & {a}^b~#\\ 4.9 × 10⁻⁴ at θ'), '50 \\% of \\$x\\_1 \\& \\{a\\}\\textasciicircum{}b\\textasciitilde{}\\#\\textbackslash{} 4.9 $\\times$ 10$^{-4}$ at $\\theta$');
  assert.equal(fileName('phong_rdf-n128', '../POV Ray<', ''), 'phong_rdf-n128-POV-Ray');
  assert.equal(csvText([['=1+2', 'a"b,c'], [1e-9, NaN]]), "'=1+2,\"a\"\"b,c\"\n1e-9,nan\n");
});
