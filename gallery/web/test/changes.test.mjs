// A gallery with earlier runs: the sentence, the filter, old against new, the timeline.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readdirSync, utimesSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { address, close, fileUrl, launch, open, program, ready, requireAccessible, says, scratch, seenAt, serve } from './browser.mjs';
import { exr, kPeak, ours, seal, writeFarm } from './farm.mjs';

const kSize = 32;
const directory = scratch(), runs = ['first', 'second', 'now'].map((name) => path.join(directory, name)), [first, second, now] = runs;
const site = path.join(directory, 'site'), small = path.join(directory, 'small');
let browser, server, publishing;

const gallery = (...args) => spawnSync(program, ['gallery', now, ...args], { encoding: 'utf8' });
const page = (file, base = fileUrl(site), options = {}) => open(browser, base + file, options);
const kWorse = 'cells/16-phong/index.html';

before(async () => {
  const axes = { model: ['phong', 'blinn', 'ward'], exponent: ['16', '128'] };
  for (const run of [first, second])
    writeFarm(run, { axes, size: kSize, cell: (i) => ({ status: i === 2 ? 'differs' : 'pass' }) });
  // The same cells by another order of the axes, without ward, with 64.
  writeFarm(now, { axes: { exponent: ['16', '128', '64'], model: ['phong', 'blinn'] }, size: kSize, cell: (i) => ({ status: i === 0 ? 'differs' : 'pass' }) });
  const old = path.join(second, 'cells/phong-16');
  writeFileSync(path.join(old, 'blender.exr'), exr(kSize, kSize, (x, y) => ours(x, y, kSize).map((v) => v / 4)));
  seal(old);
  // The farm's own dates are of this minute.
  for (const [run, day] of [[first, 10], [second, 20]])
    utimesSync(path.join(run, 'farm.json'), new Date(`2026-11-${day}T12:00:00Z`), new Date(`2026-11-${day}T12:00:00Z`));
  publishing = gallery('-o', site, '--baseline', first, '--baseline', second);
  gallery('-o', small, '--metrics-only', '--baseline', second);
  [browser, server] = await Promise.all([launch(), serve(site)]);
});
after(async () => { await browser?.close(); await server?.stop(); });

test('a cell that is worse makes exit code 1 and one line that names it', () => {
  assert.equal(publishing.status, 1, publishing.stderr);
  assert.match(publishing.stderr, /^lobelia: gallery: 1 of 6 cells is worse than in the baseline: 16-phong: Blender Cycles: pass became differs\n$/);
  assert.equal(gallery('-o', path.join(directory, 'alone')).status, 0);
});

for (const from of ['file', 'server']) {
  test(`the index from a ${from} says what changed, and the filter shows it`, async () => {
    const index = await page('index.html', from === 'file' ? fileUrl(site) : server.url);
    await says(index, '.since', /^Since 2026-11-20 \(second\): 1 cell is worse, 1 is better, 2 are new, 2 are gone, 2 are as before\.$/);
    await says(index, 'section.changes', /ward · exponent 16, which was ✓ pass/);
    const filter = index.getByRole('combobox', { name: 'Change', exact: true });
    assert.deepEqual(await filter.locator('option').allTextContents(), ['any', 'worse', 'better', 'new', 'as before']);
    for (const [name, count] of [['worse', 1], ['better', 1], ['new', 2], ['same', 2], ['', 6]]) {
      await filter.selectOption(name);
      await says(index, '.count', new RegExp(`^showing ${count} of 6 cells$`));
    }
    await filter.selectOption('worse');
    const again = await open(browser, await address(index));
    await says(again, '.count', /^showing 1 of 6 cells$/);
    assert.equal(await again.getByRole('combobox', { name: 'Change', exact: true }).inputValue(), 'worse');
    assert.equal(await again.locator('.grid .cell img').getAttribute('alt'), 'exponent 16 · phong: differs, worse');
    await close(again);
    await close(index);
  });
}

test('Find knows a change, and the heat map marks it', async () => {
  const index = await page('index.html');
  for (const [words, count] of [['change = worse', 1], ['change = new phong', 1], ['change != same', 4]]) {
    await index.locator('#find').fill(words);
    await says(index, '.count', new RegExp(`^showing ${count} of 6 cells$`));
  }
  await close(index);
  const heat = await page('index.html#show=heat');
  await heat.getByRole('link', { name: /^exponent 16 · phong: differs, worse/ }).waitFor();
  assert.equal(await heat.locator('.heat .change.worse').count(), 1);
  await close(heat);
});

test('without an earlier run there is nothing of it', async () => {
  gallery('-o', path.join(directory, 'alone'));
  const index = await page('index.html#change=worse', fileUrl(path.join(directory, 'alone')));
  await says(index, '.count', /^showing 6 of 6 cells$/);
  assert.equal(await index.getByRole('combobox', { name: 'Change', exact: true }).count(), 0);
  assert.equal(await index.locator('.since, .change').count(), 0);
  await close(index);
});

test('the viewer wipes, flips and subtracts old and new', async () => {
  const cell = await page(kWorse + '#mode=flip');
  await ready(cell);
  assert.deepEqual((await cell.getByRole('combobox', { name: 'First', exact: true }).locator('option').allTextContents()).slice(4), ['5 Blender Cycles, before']);
  await cell.getByRole('button', { name: 'Old against new' }).click();
  assert.match(await address(cell), /a=blender\.before&b=blender/);
  const byKey = await page(kWorse + '#mode=flip');
  await ready(byKey);
  await byKey.keyboard.press('b');
  assert.match(await address(byKey), /a=blender\.before&b=blender/);
  await close(byKey);
  await ready(cell, 3);
  await says(cell, '.tags', /^Blender Cycles, before$/);
  const old = await seenAt(cell, 0.5, 1 / 3);
  await cell.keyboard.press('f');
  await cell.keyboard.press('f');
  await cell.keyboard.press('f');
  const seen = await seenAt(cell, 0.5, 1 / 3);
  assert.ok(Math.max(...seen) > Math.max(...old) + 20, `${seen} is no brighter than ${old}`);
  await cell.keyboard.press('d');
  await says(cell, '.tags', /^Blender Cycles, before − Blender Cycles$/);
  await cell.keyboard.press('w');
  await says(cell, '.pixel-values tbody', /Blender, before/);
  const row = cell.locator('.pixel-values tr.sum td').first();
  // The difference of two stored differences from ours: -3/4 of the value, and Blender's own error.
  await says(cell, '.pixel-values tr.sum td', /\d/);
  const difference = Number((await row.textContent()).replace('−', '-'));
  assert.ok(Math.abs(difference / kPeak + 0.75) < 0.01, `${difference}`);
  await close(cell);
});

test('a picture that did not change is not there twice', async () => {
  assert.ok(!readdirSync(path.join(site, 'cells/16-blinn')).some((file) => file.includes('.before.')));
  const cell = await page('cells/16-blinn/index.html');
  await ready(cell);
  assert.equal(await cell.getByRole('button', { name: 'Old against new' }).count(), 0);
  await close(cell);
});

test('a site of figures alone has the old thumbnails', async () => {
  const files = readdirSync(path.join(small, 'cells/16-phong'));
  assert.ok(files.includes('blender.before.png') && !files.some((file) => file.endsWith('.float.js')), files.join(' '));
  const cell = await page(kWorse + '#a=blender.before&b=blender&mode=side', fileUrl(small));
  await says(cell, '.tags', /Blender Cycles, beforeBlender Cycles/);
  await close(cell);
});

test('axe finds nothing, in light and in dark and on a phone', async () => {
  for (const options of [{}, { colorScheme: 'dark' }, { viewport: { width: 390, height: 800 } }])
    for (const file of ['index.html', 'index.html#show=heat', kWorse, 'cells/64-phong/index.html']) {
      const shown = await page(file, fileUrl(site), options);
      await requireAccessible(shown, file);
      const wide = await shown.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wide <= 0, `${file}: ${wide} px too wide`);
      if (options.viewport && file === kWorse)
        for (const box of await Promise.all((await shown.locator('.engine-change > summary').all()).map((one) => one.boundingBox()))) assert.ok(box.height >= 24, `${box.height} px`);
      await close(shown);
    }
});
