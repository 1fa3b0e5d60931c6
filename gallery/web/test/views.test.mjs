// Explorer, stability, paper and cost: each opens, keeps its state in the link, and can be used by keys.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { address, close, fileUrl, launch, lobelia, open, requireAccessible, says, scratch, serve } from './browser.mjs';
import { writeFarm } from './farm.mjs';

const directory = scratch(), run = path.join(directory, 'run'), site = path.join(directory, 'site');
const kViews = { explorer: 'Explorer', stability: 'Stability', paper: 'Paper', cost: 'Cost', search: 'Cheapest lobes' };
const kHostile = '<img src=x onerror=alert(1)>';
const made = (kind, rest) => ({ schemaVersion: 1, kind, madeBy: 'lobelia test', ...rest });
let browser, server, tables;

function put(file, record) {
  mkdirSync(path.dirname(path.join(run, file)), { recursive: true });
  writeFileSync(path.join(run, file), JSON.stringify(record));
}

const errors = (ofPeak) => ({ ofPeak, ulp: ofPeak === 'inf' ? 'inf' : ofPeak * 1e7, wrongPixels: 0 });
const summary = (rest, naive) => ({ group: 'lobe', ...rest, cases: 3, outside: 0, notCompared: 0, naive: errors(naive), ours: errors(1e-8), ofBound: 0.5 });
const curve = (exponent) => ({ exponent, model: 'modified_phong', lobe: 'cosine', degrees: [0, 1, 2], truth: [1, 0.5, 0.1], naive: [1.2, 0.4, 'inf'], ours: [1, 0.5, 0.1] });
const claim = (name, verdict) => ({ name, where: 'eq. (1)', statement: `it is so: ${name}`, printed: '1.7e-2', verdict,
  measured: [{ what: 'largest', value: 0.017, text: '1.70e-2', at: 'n = 16' }], definition: 'by a scan', reason: '' });
const variant = (name, median, max) => ({ name, settings: {}, seconds: { median, spread: 0.05, least: median, most: median, rounds: 5 }, errors: { max } });

before(async () => {
  writeFarm(run, { axes: { model: ['phong'] }, size: 8, cell: () => ({}) });
  mkdirSync(path.join(run, 'explorer'));
  lobelia('models', '--tables', path.join(run, 'explorer/tables.json'));
  tables = JSON.parse(readFileSync(path.join(run, 'explorer/tables.json'), 'utf8'));
  put('stability/stability.json', made('verify-stability', {
    command: ['lobelia', 'verify', 'stability'], instructionSet: 'AVX2', cases: 9, outside: 0, notCompared: 0, byLobe: [], groups: [{ name: 'lobe', meaning: kHostile }],
    byCase: [summary({ case: kHostile }, 'inf')],
    byExponent: ['cosine', 'cs16'].flatMap((lobe) => [1, 100, 1e4].map((n) => summary({ lobe, exponent: n }, lobe === 'cs16' && n > 100 ? 'inf' : n * 1e-6))),
    curves: [curve(1e3), curve(1e6)],
  }));
  put('paper/paper.json', made('verify-paper', {
    command: ['lobelia', 'verify', 'paper'], confirmed: 1, notReproduced: 1, found: 1, claims: [claim('first', 'confirmed'), claim('second', 'not reproduced'), claim(kHostile, 'found')],
    figures: [{ id: 'a"b', title: 'A figure', description: 'shown', x: { label: 'n', from: 16, to: 1024, logarithmic: true, ticks: [16, 1024] },
      y: { label: 'energy', from: 0, to: 1 }, bands: [], series: [{ name: 'line', style: 1, x: [16, 128, 1024], y: [0, 0.25, 0.5] }], claims: ['second'] }],
  }));
  put('cost/cost.json', made('cost', { command: ['lobelia', 'cost'], host: { processor: 'abacus', threads: 2, system: 'Debian' }, instructionSet: 'AVX2', tables: [{
    id: 'lobe', unit: 's', level: 'lobe', title: 'A lobe', per: 'evaluation', errors: [{ id: 'max', meaning: 'largest error' }],
    ways: [variant('quick', 1e-9, 0.1), variant('middling', 2e-9, 0.05), variant('slow', 8e-9, 1e-7), variant(kHostile, 9e-9, 0.2), variant('unknown', 1e-9, 'nan')],
    fronts: { max: { ways: ['quick', 'middling', 'slow'], dominatedBy: {}, inWords: ['quick to slow'], chart: 'lobe-max.svg' } }, remarks: [] }] }));
  mkdirSync(path.join(run, 'search'));
  const searchFile = path.join(run, 'search/search.json');
  lobelia('search', '-q', '--operations', '5', '--family', 'pk', '-o', searchFile);
  const found = JSON.parse(readFileSync(searchFile, 'utf8'));
  found.lobes[0].formula = kHostile;
  put('search/search.json', found);
  lobelia('gallery', run, '-o', site);
  [browser, server] = await Promise.all([launch(), serve(site)]);
});
after(async () => { await browser?.close(); await server?.stop(); });

const view = (name, hash = '', options = {}) => open(browser, `${fileUrl(site)}${name}.html${hash}`, options);
const hashOf = (page) => page.evaluate(() => Object.fromEntries(new URLSearchParams(location.hash.slice(1))));

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

  test(`${name}: is whole without script, and on paper`, async () => {
    const page = await view(name, '', { javaScriptEnabled: false });
    assert.ok(await page.locator('main svg.chart').first().isVisible());
    assert.ok((await page.locator('main').innerText()).length > 200);
    await page.context().close();
    const printed = await view(name);
    await printed.emulateMedia({ media: 'print' });
    assert.ok(await printed.locator('main svg.chart >> visible=true').count() > 0);
    await close(printed);
  });
}

test('explorer: what the script interpolates is what the library gives', async () => {
  const bundle = path.join(directory, 'tables.mjs');
  await build({ entryPoints: [fileURLToPath(new URL('../src/explorer/tables.ts', import.meta.url))], bundle: true, format: 'esm', outfile: bundle, logLevel: 'error' });
  const { AtExponent, unpacked } = await import(bundle);
  let packed;
  const script = readFileSync(path.join(site, 'explorer.data.js'), 'utf8');
  new Function('lobelia', script)((_, json) => { packed = JSON.parse(json); });
  const ours = unpacked(packed);
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
  const models = JSON.parse(lobelia('models', '--json', '--exponent', '37.3'));
  const highlight = models.highlights.find((h) => h.model === 'blinn_phong_rdf' && h.lobe === 'cs16' && h.normalisation === 'paper');
  const page = await view('explorer', '#model=blinn_phong_rdf&lobe=cs16&norm=paper&n=37.3&two=0');
  const row = (title) => page.locator('.explorer-numbers tr', { hasText: title }).locator('td').first().textContent();
  const near = (text, value, share) => assert.ok(Math.abs(parseFloat(text) / value - 1) < share, `${text}, not ${value}`);
  near(await row('Coefficient'), highlight.coefficient, 1e-3);
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
  assert.equal(await page.locator('.explorer figure').first().locator('path.series').count(), 1);
  await close(again);
  await close(page);
});

test('explorer: a link of nonsense shows something', async () => {
  await close(await view('explorer', `#n=nan&lobe=${encodeURIComponent(kHostile)}&model=__proto__&norm=constructor&scale=x`));
});

test('stability: cases, lobe and exponent by choice; what is no number is at the top', async () => {
  const page = await view('stability');
  const top = () => page.locator('#over-exponent-figure svg.interactive path.series-2').getAttribute('d');
  const worst = await top();
  await page.locator('#lobe').selectOption('cosine');
  assert.notEqual(await top(), worst);
  await page.locator('#exponent').selectOption('1000');
  await page.locator('#show').selectOption('error');
  await page.locator('#over-angle-figure svg.interactive').focus();
  await page.keyboard.press('ArrowRight');
  await says(page, '#over-angle-figure .readout', /at 0: naive float32 0\.2/);
  const hash = await hashOf(page), again = await open(browser, await address(page));
  assert.deepEqual(hash, { lobe: 'cosine', n: '1000', show: 'error' });
  assert.equal(await again.locator('#show').inputValue(), 'error');
  await close(again);
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
  await page.locator('[data-chart] svg.interactive').focus();
  await page.keyboard.press('ArrowLeft');
  await says(page, '[data-chart] .readout', /at 1024: line 0\.5/);
  await close(page);
});

test('cost: a variant is marked in chart and table, by pointer and by keys, and in the link', async () => {
  const page = await view('cost');
  const marked = () => page.locator('.marked').evaluateAll((all) => all.map((e) => `${e.tagName} ${e.dataset.key}`).sort());
  await page.locator('tr[data-key=slow]').hover();
  assert.deepEqual(await marked(), ['TR slow', 'g slow']);
  await says(page, '.readout', /slow: 8\.00 ns ± 5 %, max/);
  await page.mouse.move(0, 0);
  assert.deepEqual(await marked(), []);
  await page.locator('g.point[data-key=quick]').focus();
  await page.keyboard.press('ArrowRight');
  assert.deepEqual(await marked(), ['TR middling', 'g middling']);
  await page.keyboard.press('Enter');
  assert.deepEqual(await hashOf(page), { table: '0', variant: 'middling' });
  const again = await open(browser, await address(page));
  assert.deepEqual(await again.locator('.marked').evaluateAll((all) => all.map((e) => e.dataset.key)), ['middling', 'middling']);
  await close(again);
  await page.keyboard.press('Enter');
  assert.equal(new URL(await address(page)).hash, '#top');
  assert.equal(await page.locator('g.point[tabindex="0"]').count(), 1);
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
