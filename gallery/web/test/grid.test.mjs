// The grid: axes, colours, filter, thousands of cells, hostile names.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { copyFileSync, existsSync, rmSync, truncateSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { address, close, fileUrl, hashOf, launch, lobelia, open, program, requireAccessible, says, scratch, serve } from './browser.mjs';
import { writeFarm } from './farm.mjs';

const kHostile = '<img src=x onerror=alert(1)>';
const directory = scratch(), site = path.join(directory, 'site'), many = path.join(directory, 'many');
let browser, server;

before(async () => {
  const status = { 3: 'failed', 5: 'differs', 7: 'missing' };
  writeFarm(path.join(directory, 'run'), {
    title: `A farm ${kHostile}`, size: 16,
    axes: { model: ['phong', 'blinn', kHostile], exponent: ['16', '128'], light: ['front', 'side'] },
    cell: (i) => ({ status: status[i] ?? 'pass' }),
  });
  lobelia('gallery', path.join(directory, 'run'), '-o', site);
  const list = (name, count) => Array.from({ length: count }, (_, i) => `${name} ${i}`);
  // One picture for all would do, but a page of 2000 that come from 2000 files is what is asked about.
  writeFarm(many, {
    size: 4, axes: { model: list('model', 50), exponent: list('exponent', 40) },
    cell: (i) => ({ pictures: i % 4 === 0 && 'thumbnail', status: i % 4 === 0 ? 'unchecked' : 'missing' }),
  });
  lobelia('gallery', many);
  [browser, server] = await Promise.all([launch(), serve(site)]);
});
after(async () => { await browser?.close(); await server?.stop(); });

const grid = (hash = '', base = fileUrl(site)) => open(browser, base + 'index.html' + hash);
const heads = (page) => page.locator('.grid').first().locator('tbody th').allTextContents();

for (const from of ['file', 'server']) {
  test(`opens from a ${from} without a complaint, every cell in its place`, async () => {
    const page = await grid('', from === 'file' ? fileUrl(site) : server.url);
    assert.equal(await page.locator('.count').textContent(), 'showing 12 of 12 cells');
    assert.deepEqual(await heads(page), ['phong', 'blinn', kHostile]);
    assert.equal(await page.locator('.grid .cell').count(), 12);
    await close(page);
  });
}

test('rows and columns can be exchanged, and any axis can be either', async () => {
  const page = await grid();
  const columns = await page.locator('.grid').first().locator('.columns th').count();
  assert.ok(columns >= 2);
  await page.getByRole('button', { name: 'Exchange rows and columns' }).click();
  assert.deepEqual((await heads(page)).sort(), ['front', 'side']);
  await page.getByRole('combobox', { name: 'Rows', exact: true }).selectOption({ label: 'exponent' });
  assert.deepEqual(await heads(page), ['exponent 16', 'exponent 128']);
  const again = await open(browser, await address(page));
  assert.deepEqual(await heads(again), ['exponent 16', 'exponent 128']);
  assert.equal(await again.locator('.grid .cell').count(), 12);
  await close(again);
  await close(page);
});

test('text and status filter, and say how many are left', async () => {
  const page = await grid();
  await page.keyboard.press('/');
  await page.keyboard.type('blinn SIDE');
  assert.equal(await page.locator('.count').textContent(), 'showing 2 of 12 cells');
  assert.equal(await page.locator('.grid .cell').count(), 2);
  await page.locator('#find').fill('');
  await page.getByRole('combobox', { name: 'Status', exact: true }).selectOption('failed');
  assert.equal(await page.locator('.count').textContent(), 'showing 1 of 12 cells');
  assert.equal((await hashOf(page)).status, 'failed');
  await page.locator('#find').fill('no such cell');
  await page.getByText('No cell is like that.').waitFor();
  await close(page);
});

test('failures can come first, then the largest differences', async () => {
  const page = await grid('#order=worst');
  const statuses = await page.locator('.cell-list .cell').evaluateAll((cells) => cells.map((c) => c.className.replace('cell ', '')));
  assert.deepEqual(statuses.slice(0, 3), ['failed', 'differs', 'missing']);
  assert.ok(statuses.slice(3).every((s) => s === 'pass'));
  await close(page);
});

test('any metric of any engine colours the cells, and its scale is shown', async () => {
  const page = await grid();
  for (const [engine, metric, words] of [['worst of all', 'Largest difference, of the peak', /0\.1 %/], ['Blender', 'Largest difference, of the peak', /0\.1 %/], ['POV-Ray', 'Largest difference', /5 × 10⁻⁶/]]) {
    await page.getByRole('combobox', { name: 'Engine', exact: true }).selectOption({ label: engine });
    await page.getByRole('combobox', { name: 'Metric', exact: true }).selectOption({ label: metric });
    assert.match(await page.locator('.legend-bar').textContent(), words);
    assert.match(await page.locator('.cell .value').first().textContent(), words);
    assert.notEqual(await page.locator('.swatch').first().evaluate((s) => s.style.background), '');
  }
  await page.getByRole('combobox', { name: 'Metric', exact: true }).selectOption('status');
  assert.equal(await page.locator('.swatch:visible').count(), 0);
  await close(page);
});

test('an error that has a sign is coloured and ranked by its size', async () => {
  const page = await grid('#colour=*/drift');
  await says(page, '.grid-bar .legend-bar', /Coloured without its sign/);
  // POV-Ray's is the largest, below 0.
  await says(page, '.cell-foot .value', /^−2 × 10⁻⁷/);
  await close(page);
});

test('a link that makes no sense shows what there is without', async () => {
  const page = await grid('#rows=99&cols=-7&group=x&status=bogus&colour=zz&order=?');
  await says(page, '.count', /^showing (\d+) of \1 cells$/);
  for (const list of await page.locator('.grid-bar select').all()) assert.ok(await list.evaluate((element) => element.selectedIndex >= 0));
  await close(page);
});

test('a cell leads to its page, and one named like markup is text everywhere', async () => {
  const page = await grid();
  await page.getByRole('link', { name: kHostile }).first().click();
  await page.waitForSelector('h1');
  assert.ok((await page.locator('h1').textContent()).includes(kHostile));
  assert.equal(await page.evaluate(() => document.querySelectorAll('img[onerror]').length), 0);
  await page.waitForFunction(() => Number(document.querySelector('.stage')?.dataset.ready) >= 2);
  assert.ok(existsSync(path.join(site, 'cells', `${kHostile}-16-front`, 'lobelia.float.js')));
  await close(page);
});

test('a bar marks the limit: below it cells are calm, over it they are not', async () => {
  const page = await grid();
  await says(page, '.legend-bar', /The mark is the limit of each cell/);
  const background = (status) => page.locator(`.cell.${status} .swatch.limited`).first().evaluate((e) => e.style.background);
  assert.match(await background('pass'), /rgba\(84, 124, 176/, 'a tenth of the limit');
  assert.match(await background('differs'), /rgb\(1[4-9]\d, \d+, \d+\)/, 'twice the limit');
  await page.goto(fileUrl(site) + 'index.html#colour=*/ssim');
  await says(page, '.legend-bar', /It has no limit here/);
  assert.equal(await page.locator('.swatch.limited').count(), 0);
  await close(page);
});

test('Find understands axes, ranges and metrics', async () => {
  const page = await grid();
  for (const [text, count] of [['exponent = 16', 6], ['exponent > 16', 6], ['exp=16..128', 12], ['exponent > 16 light = front', 3], ['model != blinn', 8],
    ['max_rel_peak > 0.05%', 11], ['max_rel_peak < 1e-9', 0], ['"largest difference, of" >= 0.1%', 11], ['nothing = 3', 0], ['exponent >', 12], ['light = side blinn', 2]]) {
    await page.locator('#find').fill(text);
    assert.equal(await page.locator('.count').textContent(), `showing ${count} of 12 cells`, text);
  }
  await close(page);
});

test('cells can be sorted by a metric, either way', async () => {
  const page = await grid('#colour=blender/drift&order=most');
  const names = () => page.locator('.cell-list .cell-name').allTextContents();
  assert.equal((await names()).length, 12);
  await page.getByRole('combobox', { name: 'Order', exact: true }).selectOption('least');
  assert.match((await names()).at(-1), /blinn . exponent 128 . side/, 'the one without a value is last');
  await close(page);
});

test('a heat map has no pictures, and says in words what it shows', async () => {
  const page = await grid('#show=heat');
  assert.equal(await page.locator('.cell.heat').count(), 12);
  assert.equal(await page.locator('.grid img').count(), 0);
  assert.equal(await page.getByRole('link', { name: /phong · exponent 16 · front: pass, 0\.1 %/ }).count(), 1);
  assert.equal(await page.locator('.cell.differs a.over').count(), 1);
  for (const colorScheme of ['light', 'dark']) {
    const one = await open(browser, fileUrl(site) + 'index.html#show=heat', { colorScheme });
    await requireAccessible(one, `heat map in ${colorScheme}`);
    await close(one);
  }
  await close(page);
});

test('of two thousand cells only those in view are in the page, wherever it is scrolled', async () => {
  const page = await open(browser, fileUrl(many) + 'index.html');
  const seen = () => page.locator('.cell').count(), box = page.locator('.grid-box');
  assert.equal(await page.locator('.count').textContent(), 'showing 2000 of 2000 cells');
  assert.equal(await page.getByRole('table').getAttribute('aria-rowcount'), '51');
  assert.ok(await seen() < 700, `${await seen()} cells`);
  await box.evaluate((e) => e.scrollTo(e.scrollWidth, e.scrollHeight));
  await page.getByTitle('model 49 · exponent 39: no picture', { exact: true }).waitFor();
  assert.ok(await seen() < 700, `${await seen()} cells`);
  assert.equal(await page.getByTitle('model 0 · exponent 0: not compared', { exact: true }).count(), 0);
  const [head, corner] = await page.evaluate(() => ['.grid .columns th:last-of-type', '.grid tbody th'].map((s) => document.querySelector(s).getBoundingClientRect().toJSON()));
  const around = await box.boundingBox();
  assert.ok(Math.abs(head.top - around.y) < 3 && Math.abs(corner.left - around.x) < 3, 'the heads hold');
  await page.locator('#find').fill('model 49');
  assert.equal(await page.locator('.count').textContent(), 'showing 40 of 2000 cells');
  await page.getByRole('button', { name: 'Exchange rows and columns' }).click();
  assert.ok(await seen() > 0 && await seen() <= 40);
  await close(page);
  const long = await open(browser, fileUrl(many) + 'index.html#order=worst&status=unchecked');
  assert.equal(await long.locator('.cell-list li').first().getAttribute('aria-setsize'), '500');
  assert.ok(await long.locator('.cell img').count() < 300);
  await close(long);
});

test('Tab goes from cell to cell through all of the grid, and back from a cell is where one was', async () => {
  const page = await open(browser, fileUrl(many) + 'index.html');
  const focused = () => page.evaluate(() => document.activeElement.title);
  await page.locator('.grid-box').focus();
  for (let i = 0; i < 85; ++i) {
    await page.keyboard.press('Tab');
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    const title = await focused();
    assert.ok(title.startsWith(`model ${Math.floor(i / 40)} · exponent ${i % 40}:`), `${i}: ${title}`);
  }
  await page.locator('.grid-box').evaluate((e) => { e.scrollTop = 2000; });
  await page.getByTitle(/^model 28 · exponent 4:/).click();
  await page.waitForSelector('h1');
  await page.goBack();
  await page.waitForFunction(() => Math.abs(document.querySelector('.grid-box').scrollTop - 2000) < 300);
  await close(page);
});

test('a phone scrolls the grid in its box alone, under heads that hold', async () => {
  const page = await open(browser, fileUrl(many) + 'index.html', { viewport: { width: 390, height: 800 } });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await page.locator('.grid-box').evaluate((e) => e.scrollTo(900, 700));
  await page.waitForFunction(() => [...document.querySelectorAll('.columns th:not(.corner)')].some((e) => e.textContent === 'exponent 14'));
  const [head, box] = await Promise.all(['.grid thead', '.grid-box'].map((name) => page.locator(name).boundingBox()));
  assert.ok(Math.abs(head.y - box.y) <= 2, `the head is at ${head.y}, its box at ${box.y}`);
  await requireAccessible(page, 'the grid on a phone');
  await close(page);
});

test('what is not as the farm wrote it is first, marked in words, and has its reason on its page', async () => {
  const odd = path.join(directory, 'odd'), run = path.join(directory, 'odd-run');
  writeFarm(run, { size: 16, axes: { model: ['phong', 'blinn'], exponent: ['16', '128'] }, cell: (i) => ({ status: i === 3 ? 'failed' : 'pass' }) });
  const cell = (id, file) => path.join(run, 'cells', id, file);
  rmSync(cell('phong-16', 'lobelia-povray.json'));
  truncateSync(cell('phong-128', 'povray.exr'), 900);
  copyFileSync(cell('phong-128', 'blender.exr'), cell('blinn-16', 'povray.exr'));
  const { status, stderr } = spawnSync(program, ['gallery', run, '-o', odd], { encoding: 'utf8' });
  assert.equal(status, 1);
  assert.match(stderr, /3 of 4 cells are not what the farm wrote/);
  for (const colorScheme of ['light', 'dark']) {
    const page = await open(browser, fileUrl(odd) + 'index.html#order=worst', { colorScheme });
    await requireAccessible(page, `index ${colorScheme}`);
    assert.match(await page.locator('.doubts').innerText(), /3 cells are not what the farm wrote/);
    const cells = page.locator('.cell-list .cell');
    assert.deepEqual(await cells.evaluateAll((all) => all.map((c) => c.className)), ['cell damaged', 'cell lost', 'cell changed', 'cell failed']);
    assert.deepEqual((await cells.locator('.status').allInnerTexts()).slice(0, 3), ['!damaged', '∅missing', 'Δchanged']);
    assert.equal(await page.locator('.status.pass').count(), 1, 'the counts say: none');
    await page.locator('#find').fill('missing');
    assert.equal(await page.locator('.count').textContent(), 'showing 1 of 4 cells');
    await close(page);
    for (const [id, words] of [['phong-16', /lobelia-povray\.json is missing/], ['phong-128', /povray\.exr cannot be read/], ['blinn-16', /povray\.exr is not the file that the farm wrote/]]) {
      const one = await open(browser, `${fileUrl(odd)}cells/${id}/index.html`, { colorScheme });
      assert.match(await one.locator('.verdict .flaws').innerText(), words);
      await requireAccessible(one, `${id} ${colorScheme}`);
      await close(one);
    }
  }
});

test('axe finds nothing in the grid and in the list, in light, in dark and in forced colours', async () => {
  for (const colours of [{ colorScheme: 'light' }, { colorScheme: 'dark' }, { forcedColors: 'active' }]) {
    for (const hash of ['', '#order=worst&find=blinn']) {
      const page = await open(browser, fileUrl(site) + 'index.html' + hash, colours);
      await requireAccessible(page, `grid ${hash} in ${JSON.stringify(colours)}`);
      await close(page);
    }
  }
});

test('forced colours leave the heat map and its scale their colours', async () => {
  const page = await open(browser, fileUrl(site) + 'index.html#show=heat', { forcedColors: 'active' });
  const ground = (selector) => page.locator(selector).first().evaluate((e) => getComputedStyle(e).background);
  assert.match(await ground('.ramp'), /linear-gradient/);
  assert.match(await ground('.heat > a'), /rgba?\((?!0, 0, 0, 0)/);
  await close(page);
});
