// The report of `lobelia compare --html`: a site of anyone's pictures, and the same in one file.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { address, close, fileUrl, launch, open, program, ready, requireAccessible, says, scratch } from './browser.mjs';
import { exr, ours, png } from './farm.mjs';

const kHostile = `<img src=x onerror=alert(1)>'"&#60;%2e.exr`, kSize = 64;
const directory = scratch(), site = path.join(directory, 'report'), single = path.join(directory, 'one.html');
const file = pathToFileURL(single).href;
let browser;

const compare = (...args) => {
  const { status, stderr } = spawnSync(program, ['compare', ...args], { cwd: directory, encoding: 'utf8' });
  assert.ok(status === 0 || status === 1, stderr);
};
/** Our picture, brighter by `factor` and moved by `shift` pixels. */
const picture = (factor = 1, shift = 0) => exr(kSize, kSize, (x, y) => ours(x - shift, y, kSize).map((v) => v * factor));
const put = (name, bytes) => { mkdirSync(path.dirname(path.join(directory, name)), { recursive: true }); writeFileSync(path.join(directory, name), bytes); };

before(async () => {
  for (const name of ['same', 'dim', 'moved', kHostile]) put(`reference/${name}${name === kHostile ? '' : '.exr'}`, picture());
  put('reference/lost.exr', picture());
  put('reference/8-bit.png', png(kSize, kSize, (x, y) => ours(x, y, kSize).map((v) => Math.min(255, Math.round(90 * v)))));
  put('mine/8-bit.png', readFileSync(path.join(directory, 'reference/8-bit.png')));
  put('mine/same.exr', picture());
  put('mine/dim.exr', picture(0.9));
  put('mine/moved.exr', picture(1, 3));
  put(`mine/${kHostile}`, picture(1.02));
  put('mine/extra.exr', picture());
  put('old/same.exr', picture(0.5));
  compare('mine', 'reference', 'old', '--html', 'three');
  compare('mine', 'reference', '--html', 'report');
  compare('mine', 'reference', '--html', 'one.html', '--single-file', '--title', 'Mine </script><script>alert(1)</script>');
  browser = await launch();
});
after(() => browser?.close());

/** Of the seven pairs, once all rows are drawn: those that come into view are. */
const names = async (page) => {
  await page.locator('.of-pairs .cell-name').nth(6).waitFor({ state: 'attached' });
  return page.locator('.of-pairs .cell-name').allTextContents();
};

test('lists all pairs, the worst first, each with its pictures and a sentence', async () => {
  const page = await open(browser, fileUrl(site) + 'index.html');
  assert.equal(await page.locator('.count').textContent(), 'showing 7 of 7 names');
  assert.equal((await page.locator('.counts').textContent()).replace(/\s+/g, ''), '5pairs2pass3differ0notfinite0errors1missing1extra');
  const list = await names(page);
  assert.deepEqual(list.slice(0, 2), ['lost.exr', 'moved.exr'], 'what is missing, and then what is the most times over its limit');
  assert.deepEqual(list.slice(2, 4).sort(), ['dim.exr', kHostile].sort());
  const dim = page.locator('.of-pairs li', { hasText: 'dim.exr' });
  assert.equal(await dim.locator('img').count(), 3, 'the reference, the other and their difference');
  assert.match(await dim.locator('.finding').textContent(), /^mine's highlight is 10 % dimmer, its energy 10 % less; the highlight at \(32, 21\) has 10 % less light$/);
  assert.match(await page.locator('.of-pairs li', { hasText: 'moved.exr' }).locator('.finding').textContent(), /3 pixels to the right/);
  for (const image of await page.locator('.of-pairs img').all()) await image.scrollIntoViewIfNeeded();
  await page.waitForFunction(() => [...document.querySelectorAll('.of-pairs img')].every((i) => i.complete && i.naturalWidth > 0));
  await requireAccessible(page, 'the report');
  await close(page);
});

const opensPair = (from, address) => test(`a pair ${from} shows the values, the region that was judged and a histogram`, async () => {
  const page = await open(browser, address);
  await ready(page);
  await says(page, 'h1', /^dim\.exr$/);
  await says(page, '.verdict .finding', /10 % dimmer/);
  await page.waitForFunction(() => document.querySelector('.overlay .region')?.getAttribute('d')?.length > 50);
  // The outline encloses the pixels with a twentieth of the peak of either.
  const box = await page.evaluate(() => { const { x, y, width, height } = document.querySelector('.overlay .region').getBBox(); return { x, y, width, height }; });
  let least = kSize, most = 0;
  for (let x = 0; x < kSize; ++x) if (ours(x, Math.round(kSize / 3), kSize)[0] >= 0.05 * ours(kSize / 2, Math.round(kSize / 3), kSize)[0]) { least = Math.min(least, x); most = Math.max(most, x); }
  assert.deepEqual([box.x, box.width], [least, most + 1 - least]);
  await page.getByText('Outline the highlight').click();
  await page.waitForFunction(() => !document.querySelector('.overlay .region'));
  await page.locator('.stage').focus();
  await page.keyboard.press('w');
  await says(page, '.pixel-values .sum', /Difference/);
  const [reference, mine] = await page.locator('.pixel-values tbody tr td:nth-child(2)').allTextContents();
  assert.ok(Math.abs(Number(mine) / Number(reference) - 0.9) < 2e-3, `${mine} of ${reference}`);
  await page.locator('.histogram summary').click();
  await page.waitForFunction(() => document.querySelectorAll('.histogram .series').length >= 2);
  await requireAccessible(page, 'a pair');
  await close(page);
});
opensPair('from a folder', fileUrl(site) + 'cells/dim.exr/index.html');
opensPair('in one file', file + '#page=cells/dim.exr/index.html');

test('one file holds everything: it asks for nothing else, and links lead from pair to pair', async () => {
  const page = await open(browser, file);
  assert.deepEqual(await names(page), await (async () => { const other = await open(browser, fileUrl(site) + 'index.html'); const list = await names(other); await close(other); return list; })());
  await page.locator('.of-pairs .cell-name', { hasText: 'moved.exr' }).click();
  await says(page, 'h1', /^moved\.exr$/);
  await ready(page);
  await page.getByRole('button', { name: 'Difference', exact: true }).click();
  await page.locator('#measure, select').last().waitFor();
  const linked = await address(page);
  assert.match(linked, /#page=cells%2Fmoved\.exr%2Findex\.html&mode=diff$/);
  await page.locator('nav.axes a', { hasText: 'dim.exr' }).click();
  await says(page, 'h1', /^dim\.exr$/);
  assert.match(await address(page), /mode=diff/, 'the way of looking comes along');
  await page.locator('a.site-title').click();
  await says(page, '.count', /showing 7 of 7 names/);
  assert.deepEqual([...page.requested].filter((url) => !url.startsWith('data:')).map((url) => url.split('#')[0]).filter((url) => url !== file), []);
  const again = await open(browser, linked);
  await says(again, 'h1', /^moved\.exr$/);
  await close(again);
  await close(page);
});

test('one file lets nothing run that it did not come with', async () => {
  const page = await open(browser, file);
  const ran = await page.evaluate(async () => {
    const add = (tag, properties) => document.head.append(Object.assign(document.createElement(tag), properties));
    add('script', { textContent: 'globalThis.ran = 1' });
    add('img', { src: 'http://127.0.0.1:9/' });
    await new Promise((done) => setTimeout(done, 100));
    return globalThis.ran;
  });
  assert.equal(ran, undefined);
  await page.context().close();
});

test('names of files are text, in links and on pages', async () => {
  for (const base of [fileUrl(site) + 'index.html', file]) {
    const page = await open(browser, base);
    await page.locator('.of-pairs .cell-name', { hasText: '<img' }).click();
    await says(page, 'h1', /^<img src=x onerror=alert\(1\)>'"&#60;%2e\.exr$/);
    await ready(page);
    await close(page);
  }
});

test('of three sets each is seen beside the reference', async () => {
  const page = await open(browser, fileUrl(path.join(directory, 'three')) + 'cells/same.exr/index.html');
  await ready(page);
  assert.deepEqual((await page.getByRole('combobox', { name: 'First' }).locator('option').allTextContents()),
    ['1 reference (reference)', '2 mine', '3 old']);
  const rows = await page.locator('.agreement tbody tr').allTextContents();
  assert.match(rows[0], /^mine[^]*✓ pass/);
  assert.match(rows[1], /^old[^]*≠ differs/);
  await close(page);
});

test('a missing picture is said, and what there is of the pair is shown', async () => {
  const page = await open(browser, fileUrl(site) + 'cells/lost.exr/index.html');
  await says(page, '.verdict', /There is only a reference/);
  await ready(page, 1);
  await close(page);
});

test('a phone shows the list without scrolling sideways', async () => {
  const page = await open(browser, fileUrl(site) + 'index.html', { viewport: { width: 390, height: 800 } });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await close(page);
});
