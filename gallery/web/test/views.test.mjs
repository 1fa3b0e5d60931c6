// Explorer, stability, paper and cost: each opens, keeps its state in the link, and can be used by keys.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { address, close, fileUrl, hashOf, launch, lobelia, open, requireAccessible, says, scratch, serve } from './browser.mjs';
import { writeFarm } from './farm.mjs';
import { writeStudies } from './studies.mjs';

const directory = scratch(), run = path.join(directory, 'run'), site = path.join(directory, 'site');
const kViews = { explorer: 'Explorer', stability: 'Stability', paper: 'Paper', cost: 'Cost', search: 'Cheapest lobes' };
const kHostile = '<img src=x onerror=alert(1)>';
let browser, server, tables;

before(async () => {
  writeFarm(run, { axes: { model: ['phong'] }, size: 8, cell: () => ({}) });
  tables = writeStudies(run, kHostile);
  lobelia('gallery', run, '-o', site);
  [browser, server] = await Promise.all([launch(), serve(site)]);
});
after(async () => { await browser?.close(); await server?.stop(); });

const view = (name, hash = '', options = {}) => open(browser, `${fileUrl(site)}${name}.html${hash}`, options);

for (const [name, title] of Object.entries(kViews)) {
  test(`${name}: opens from a file and from a server, is linked, and axe finds nothing in light or dark`, async () => {
    for (const colorScheme of ['light', 'dark']) {
      const page = await view(name, '', { colorScheme });
      await requireAccessible(page, `${name} ${colorScheme}`);
      assert.equal(await page.locator('nav a[aria-current]').textContent(), title);
      await close(page);
    }
    await close(await open(browser, `${server.url}${name}.html`));
  });

  test(`${name}: is whole on paper`, async () => {
    const printed = await view(name);
    await printed.emulateMedia({ media: 'print' });
    assert.ok(await printed.locator('main svg.chart >> visible=true').count() > 0);
    await close(printed);
  });
}

test('explorer: what the script interpolates is what the library gives', async () => {
  const bundle = path.join(directory, 'tables.mjs');
  await build({ entryPoints: [fileURLToPath(new URL('../src/explorer/tables.ts', import.meta.url))], bundle: true, format: 'esm', outfile: bundle, logLevel: 'error' });
  const { AtExponent } = await import(bundle);
  let ours;
  const script = readFileSync(path.join(site, 'explorer.data.js'), 'utf8');
  new Function('lobelia', script)((_, json) => { ours = JSON.parse(json).tables; });
  assert.deepEqual(ours.lobes.map((l) => l.curves), tables.lobes.map((l) => l.curves));
  // Anywhere, but the same in every run.
  for (const n of [1, 1.37, 5.21, 16, 37.3, 64.5, 700.9, 3333, 16384]) {
    const file = path.join(directory, 'at.json');
    lobelia('models', '--tables', file, '--exponent', String(n));
    const exact = JSON.parse(readFileSync(file, 'utf8')), at = new AtExponent(ours, n);
    const near = (a, b, bound, what) => assert.ok(Math.abs(a - b) <= bound, `${what} at ${n}: ${a}, not ${b}`);
    exact.lobes.forEach((lobe, l) => {
      const curve = at.curve(ours.lobes[l]);
      near(at.halfWidth(ours.lobes[l]) / (lobe.halfWidth[0] * 180 / Math.PI), 1, tables.error.halfWidth, lobe.name);
      near(curve.x.at(-1) / (lobe.reach[0] * 180 / Math.PI), 1, tables.error.halfWidth, lobe.name);
      assert.equal(curve.y.length, lobe.curves[0].length);
      lobe.curves[0].forEach((v, i) => {
        const truth = lobe.order > 0 ? (v * lobe.unit) ** lobe.order : Math.exp(v * lobe.unit);
        near(curve.y[i], truth, tables.error.curve, `${lobe.name}, point ${i}`);
      });
    });
    exact.highlights.forEach((highlight, h) => {
      const name = `${highlight.model} ${highlight.lobe}`;
      for (const how of ['exact', 'paper'])
        if (highlight[how]) near(at.coefficient(ours.highlights[h], how) / highlight[how][0], 1, tables.error.coefficient, name);
      for (const side of ['seen', 'lit']) {
        if (!highlight[side]) continue;
        const values = at.albedo(ours.highlights[h], 'exact', side === 'lit');
        const last = values.y.length - 1, count = highlight[side][0].length;
        highlight[side][0].forEach((v, i) => {
          const j = last - i * last / (count - 1);
          const truth = Math.exp(v * highlight.unit) / (side === 'lit' ? Math.cos(values.x[j] * Math.PI / 180) : 1);
          near(values.y[j] / truth, 1, 2 * tables.error.albedo, `${name} ${side}, point ${i}`);
        });
      }
    });
  }
});

test('explorer: says what the library says, from a link', async () => {
  const models = JSON.parse(lobelia('models', '--json', '-', '--exponent', '37.3'));
  const highlight = models.highlights.find((h) => h.model === 'blinn_phong_rdf' && h.lobe === 'cs16' && h.normalisation === 'paper');
  const page = await view('explorer', '#model=blinn_phong_rdf&lobe=cs16&norm=paper&n=37.3&two=0');
  const row = (title) => page.locator('.explorer-numbers tr', { hasText: title }).locator('td').first().textContent();
  const near = (text, value, share) => assert.ok(Math.abs(parseFloat(text) / value - 1) < share, `${text}, not ${value}`);
  near(await row('Coefficient, of the radiance'), highlight.coefficient, 1e-3);
  near(await row('Energy at normal incidence'), highlight.energyAtNormalIncidence, 2e-3);
  near(await row('Most of a beam'), highlight.albedoOfLight.largest, 4e-3);
  near(await row('Half-width'), models.lobes.find((l) => l.name === 'cs16').halfWidthDegrees, 1e-3);
  assert.equal(await page.locator('.explorer-numbers thead th').count(), 1);
  await close(page);
});

test('explorer: exponent by slider and by number, two highlights, all of it in the link', async () => {
  const page = await view('explorer');
  const drawn = () => page.locator('.explorer svg.interactive path.series').first().getAttribute('d');
  const before = await drawn();
  await page.locator('#slide').focus();
  await page.keyboard.press('ArrowRight');
  const n = Number(await page.locator('#n').inputValue());
  assert.ok(n > 64 && n < 66, `${n}`);
  assert.notEqual(await drawn(), before);
  await page.locator('#n').fill('100000000');
  await page.locator('#n').press('Enter');
  await says(page, '.explorer-numbers tbody tr:first-child td', /^16384$/);
  await page.locator('#n').fill('20');
  await page.locator('#n').press('Enter');
  await page.locator('#lobe2').selectOption('schlick');
  await page.locator('#explorer-scale').selectOption('log');
  assert.equal(await page.locator('#norm2 option[value=paper]').evaluate((option) => option.disabled), true);
  const hash = await hashOf(page), again = await open(browser, await address(page));
  assert.deepEqual([hash.n, hash.lobe2, hash.scale], ['20', 'schlick', 'log']);
  assert.equal(await again.locator('#n').inputValue(), '20');
  assert.equal(await again.locator('.explorer svg.interactive path.series').first().getAttribute('d'), await drawn());
  await page.locator('#two').uncheck();
  assert.equal(await page.locator('.explorer svg.interactive').first().locator('path.series').count(), 1);
  await close(again);
  await close(page);
});

test('explorer: a link of nonsense shows something', async () => {
  await close(await view('explorer', `#n=nan&lobe=${encodeURIComponent(kHostile)}&model=__proto__&norm=constructor&scale=x`));
});

test('stability and paper: one chart a screen, and each row of pictures is a figure', async () => {
  for (const name of ['stability', 'paper']) {
    const page = await view(name), lefts = await page.locator('.figure-grid .chart-figure:visible').evaluateAll((all) => all.map((e) => e.getBoundingClientRect().left));
    assert.ok(lefts.length >= 1 && new Set(lefts).size === 1, `${name}: ${lefts}`);
    await close(page);
  }
  const page = await open(browser, `${server.url}stability.html`, { acceptDownloads: true });
  assert.equal(await page.locator('.charts .finding').count(), 2, 'each chart has its sentence');
  await page.waitForFunction(() => [...document.querySelectorAll('.picture-four img')].every((i) => i.complete && i.naturalWidth > 0));
  await page.getByRole('button', { name: 'Figure: Close to a highlight, n = 1000' }).click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('dialog').getByRole('button', { name: 'SVG' }).click()]);
  const text = readFileSync(await download.path(), 'utf8');
  assert.match(text, /href="data:image\/png;base64,/);
  for (const words of ['naive float32', 'error of ours: at most 0.01', '10⁻⁸']) assert.ok(text.includes(words), words);
  await close(page);
});

test('paper: claims by verdict and words, and a link to one shows it', async () => {
  const page = await view('paper');
  await says(page, '.count', /showing 3 of 3/);
  await page.keyboard.press('/');
  await page.keyboard.type('second');
  await says(page, '.count', /showing 1 of 3/);
  assert.equal(await page.locator('.claim:visible').getAttribute('data-verdict'), 'not reproduced');
  await page.getByLabel('Verdict').selectOption('confirmed');
  await says(page, '.count', /showing 0 of 3/);
  const again = await open(browser, await address(page));
  await says(again, '.count', /showing 0 of 3/);
  await again.locator('.figures-section a', { hasText: 'second' }).click();
  await again.locator('#claim-2').waitFor();
  await close(again);
  assert.equal(await page.locator('.chart-figure .figure-button').count(), await page.locator('.chart-figure svg.chart').count(), 'each chart is a figure');
  await close(page);
});

test('cost: a variant is marked in chart and table, by pointer and by keys, and in the link', async () => {
  const page = await view('cost');
  const marked = () => page.locator('tr.marked, .wide .marked').evaluateAll((all) => all.map((e) => `${e.tagName} ${e.dataset.key}`).sort());
  await page.locator('tr[data-key=slow]').hover();
  assert.deepEqual(await marked(), ['TR slow', 'g slow']);
  await says(page, '.readout', /slow: 8\.00 ns, ± 5 %, largest error/);
  await page.mouse.move(0, 0);
  assert.deepEqual(await marked(), []);
  await page.locator('.wide g.point[data-key=quick]').focus();
  await page.keyboard.press('ArrowRight');
  assert.deepEqual(await marked(), ['TR middling', 'g middling']);
  await page.keyboard.press('Enter');
  assert.deepEqual(await hashOf(page), { table: '0', variant: 'middling' });
  const again = await open(browser, await address(page));
  assert.deepEqual(await again.locator('tr.marked, .wide .marked').evaluateAll((all) => all.map((e) => e.dataset.key)), ['middling', 'middling']);
  await close(again);
  await page.keyboard.press('Enter');
  assert.equal(new URL(await address(page)).hash, '#top');
  assert.equal(await page.locator('.wide g.point[tabindex="0"]').count(), 1);
  await close(page);
});

test('no page has a formula as it is typed, or a path of the machine that made the run', async () => {
  for (const name of Object.keys(kViews)) {
    const page = await view(name);
    const words = await page.evaluate(() => {
      for (const details of document.querySelectorAll('details')) details.open = true;
      for (const exempt of document.querySelectorAll('pre:not(.command), .choice pre')) exempt.remove();
      return document.querySelector('main').innerText;
    });
    for (const typed of [/\d[eE][-+]?\d/, /sqrt\(/, /\^[n(\d]/, /theta_/, /\(1 - /, /± 0 %/, /\/srv\//, /\/tmp\//])
      assert.doesNotMatch(words, typed, `${name}: ${typed}`);
    await close(page);
  }
});

test('cost: is read on a phone, and its chart is a figure', async () => {
  const page = await view('cost', '', { viewport: { width: 390, height: 800 }, acceptDownloads: true });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing is wider than the screen');
  assert.equal(await page.locator('.wide svg.chart').first().isVisible(), false);
  const small = await page.locator('.narrow svg.chart').first().evaluate((chart) => Math.min(...[...chart.querySelectorAll('text')].map((t) => parseFloat(getComputedStyle(t).fontSize))) * chart.clientWidth / chart.viewBox.baseVal.width);
  assert.ok(small > 10, `the smallest letters have ${small} pixels`);
  await page.locator('.narrow .figure-button').first().click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('dialog').getByRole('button', { name: /^CSV/ }).click()]);
  assert.equal(download.suggestedFilename(), 'cost-lobe-max.csv');
  const lines = readFileSync(await download.path(), 'utf8').trim().split('\n');
  assert.equal(lines.length, 5);
  assert.ok(lines.includes('quick,1,0.1'), lines.join('\n'));
  await close(page);
});

test('search: the slider shows one exponent at a time, the whole range first', async () => {
  const page = await view('search');
  const shown = page.locator('figure[data-exponent]:visible');
  assert.equal(await shown.count(), 1);
  const first = await shown.getAttribute('data-exponent');
  const slider = page.getByRole('slider');
  await slider.focus();
  await page.keyboard.press('ArrowRight');
  assert.equal(await shown.count(), 1);
  assert.notEqual(await shown.getAttribute('data-exponent'), first);
  await slider.press('Home');
  assert.equal(await shown.getAttribute('data-exponent'), first);
  assert.equal(await slider.getAttribute('aria-valuetext'), first);
  await close(page);
});
