// A site in few files: thumbnails in the grid, and one page for all cells.
import assert from 'node:assert/strict';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { spawnSync } from 'node:child_process';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { address, close, fileUrl, launch, lobelia, open, program, requireAccessible, says, scratch, serve } from './browser.mjs';
import { seal, writeFarm } from './farm.mjs';

const kHostile = "<img src=x onerror=alert(1)>'&#\u{1f4a1}";
const directory = scratch(), run = path.join(directory, 'run'), site = path.join(directory, 'site'), old = path.join(directory, 'old');
let browser, server;

before(async () => {
  writeFarm(run, {
    title: `A farm ${kHostile}`, size: 128,
    axes: { model: ['phong', 'blinn', kHostile], exponent: ['16', '128', '1024'], light: ['front', 'side', 'top', 'back'] },
    cell: (i) => ({ status: { 3: 'failed', 5: 'differs', 7: 'missing', 9: 'unchecked' }[i] ?? 'pass', pictures: i === 9 ? false : true }),
  });
  lobelia('gallery', run, '-o', site, '--metrics-only', '--packed');
  lobelia('gallery', run, '-o', old, '--metrics-only');
  [browser, server] = await Promise.all([launch(), serve(site)]);
});
after(async () => { await browser?.close(); await server?.stop(); });

const cellAt = (id, more = '', base = fileUrl(site)) => open(browser, `${base}cell.html#${new URLSearchParams({ cell: id })}${more}`);
const opened = (page) => page.locator('.viewer').waitFor();
/** Every picture of this kind is there and has pixels. */
const arePainted = (page, selector) => page.waitForFunction((s) => {
  const all = [...document.querySelectorAll(s)];
  return all.length > 0 && all.every((image) => image.complete && image.naturalWidth > 1);
}, selector);

for (const from of ['file', 'server']) {
  test(`the grid shows thumbnails, and a click opens the cell, from a ${from}`, async () => {
    const page = await open(browser, (from === 'file' ? fileUrl(site) : server.url) + 'index.html');
    await arePainted(page, '.cell img');
    assert.ok(await page.locator('.cell img').count() > 20);
    assert.ok([...page.requested].filter((url) => url.includes('thumbnails')).length >= 1);
    await requireAccessible(page, 'the grid');
    await page.locator('.cell > a').first().click();
    await opened(page);
    assert.match(await page.title(), /^phong · exponent 16 · front · A farm/);
    assert.equal(await page.locator('h1').textContent(), 'phong · exponent 16 · front');
    assert.match(await page.locator('.verdict').textContent(), /pass/);
    assert.ok(await page.locator('table.metrics, table.figures, section table').count() > 1);
    await page.locator('.picture img').first().waitFor({ state: 'attached' });
    assert.match(await page.locator('.picture img').first().getAttribute('src'), /^data:image\/bmp;base64,/);
    await requireAccessible(page, 'a cell');
    await close(page);
  });
}

test('next and previous keep what the reader has chosen, and the back button leads back', async () => {
  const page = await cellAt('phong-16-front', '&mode=diff');
  await opened(page);
  await page.getByRole('link', { name: 'Next light: side' }).click();
  await says(page, 'h1', /^phong · exponent 16 · side$/);
  await opened(page);
  assert.match(await address(page), /cell=phong-16-side/);
  assert.match(await address(page), /mode=diff/);
  await page.getByRole('link', { name: 'Previous light: front' }).click();
  await says(page, 'h1', /^phong · exponent 16 · front$/);
  await page.goBack();
  await says(page, 'h1', /^phong · exponent 16 · side$/);
  await page.evaluate(() => { location.hash = '#main'; });
  await says(page, 'h1', /^phong · exponent 16 · side$/);
  await page.waitForFunction(() => location.hash.includes('cell=phong-16-side'));
  await close(page);
});

test('a cell has all that its page had, in words and in curves', async () => {
  const packed = await cellAt('phong-16-front'), single = await open(browser, fileUrl(old) + 'cells/phong-16-front/index.html');
  await Promise.all([opened(packed), opened(single)]);
  const words = (page) => page.evaluate(() => [...document.querySelectorAll('main header, main .table-wrap, main .chart-figure.scripted-only')]
    .map((e) => e.textContent.replace(/\s+/g, ' ')).filter((text) => !text.includes('drawn')));
  assert.deepEqual(await words(packed), await words(single));
  for (const scale of ['ratio', 'error']) {
    const curves = async (page) => { await page.locator('#profile-scale').selectOption(scale); return page.locator('.chart-figure.scripted-only svg path, .chart-figure.scripted-only svg polyline').evaluateAll((all) => all.map((e) => (e.getAttribute('d') ?? e.getAttribute('points')).match(/-?[\d.]+/g)?.map(Number) ?? [])); };
    const [a, b] = [await curves(packed), await curves(single)];
    assert.equal(a.length, b.length);
    a.forEach((line, i) => line.forEach((v, k) => assert.ok(Math.abs(v - b[i][k]) < 1.5, `${scale}: ${v} ${b[i][k]}`)));
  }
  await close(packed);
  await close(single);
});

test('the pictures have the colours of the files', async () => {
  const page = await cellAt('phong-16-front');
  await opened(page);
  const middle = (src) => page.evaluate(async (from) => {
    const image = new Image();
    image.src = from;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    return [canvas.width, canvas.height, ...context.getImageData(canvas.width / 2, Math.floor(canvas.height / 3), 1, 1).data.slice(0, 3), ...context.getImageData(2, canvas.height - 2, 1, 1).data.slice(0, 3)];
  }, src);
  const sources = await page.locator('.picture-row.engines img').evaluateAll((all) => all.map((i) => i.getAttribute('src')));
  assert.equal(sources.length, 4);
  const whole = await middle('data:image/png;base64,' + readFileSync(path.join(run, 'cells/phong-16-front/lobelia.png')).toString('base64'));
  for (const src of sources) {
    const [width, height, ...colours] = await middle(src);
    assert.deepEqual([width, height], [48, 48]);
    colours.forEach((c, i) => assert.ok(Math.abs(c - whole[2 + i]) < 20, `${colours} ${whole}`));
  }
  await close(page);
});

test('a name that is markup is text, and its cell opens', async () => {
  const page = await open(browser, fileUrl(site) + 'index.html#find=onerror');
  await page.locator('.cell > a').first().click();
  await opened(page);
  assert.ok((await page.locator('h1').textContent()).startsWith(kHostile));
  assert.equal(await page.locator('main img[onerror]').count(), 0);
  await close(page);
});

test('a link to a cell that is not there says so, and so does one without a name', async () => {
  for (const [id, words] of [['nothing', /has no cell “nothing”/], ['zzz<b>', /no cell “zzz<b>”/], ['', /names no cell/]]) {
    const page = await cellAt(id);
    await says(page, 'main p', words);
    await requireAccessible(page, 'no cell');
    await page.getByRole('link', { name: 'All cells' }).click();
    await page.locator('.cell').first().waitFor();
    await close(page);
  }
});

test('a missing and a failed cell have their pages', async () => {
  const page = await cellAt('phong-128-back');
  await says(page, '.verdict', /no picture/);
  await close(page);
});

test('without script the index names the worst cells, and a cell asks for the script', async () => {
  const page = await open(browser, fileUrl(site) + 'index.html', { javaScriptEnabled: false });
  assert.match(await page.locator('#grid').textContent(), /need the script/);
  assert.match(await page.locator('.attention').textContent(), /failed\s*phong · exponent 16 · back/);
  await page.goto(fileUrl(site) + 'cell.html');
  assert.match(await page.locator('main').textContent(), /needs its script/);
  await close(page);
});

test('float pictures have no place in it', () => {
  const { status, stderr } = spawnSync(program, ['gallery', run, '-o', path.join(directory, 'float'), '--packed'], { encoding: 'utf8' });
  assert.equal(status, 2);
  assert.match(stderr, /--metrics-only/);
});

test('a picture that cannot be decoded is a sentence, and a damaged file of cells says so', async () => {
  const broken = path.join(directory, 'broken'), cell = path.join(broken, 'cells/phong'), place = path.join(directory, 'broken-site');
  writeFarm(broken, { axes: { model: ['phong'] }, size: 16 });
  const bytes = readFileSync(path.join(cell, 'povray.png'));
  bytes.fill(0, 45, bytes.length - 20);
  writeFileSync(path.join(cell, 'povray.png'), bytes);
  seal(cell);
  lobelia('gallery', broken, '-o', place, '--metrics-only', '--packed');
  const page = await cellAt('phong', '', fileUrl(place));
  await opened(page);
  assert.match(await page.locator('section.pictures').textContent(), /povray\.png cannot be read/);
  await close(page);
  const file = path.join(place, 'packed/0.cells.data.js'), whole = readFileSync(file, 'utf8');
  for (const damage of [(text) => text.replace(/("pixels":\["[^"]{20})[^"]*/, '$1'), (text) => text.replace(/("texts":"[^"]{40})[^"]*/, '$1'), (text) => text.replace(/"curves":"[^"]*"/, '"curves":"eJwDAAAAAAE="')]) {
    const text = damage(whole);
    assert.notEqual(text, whole);
    writeFileSync(file, text);
    const hostile = await cellAt('phong', '', fileUrl(place));
    await says(hostile, 'main p', /^packed\/0\.cells\.data\.js is damaged: [^\n]+$/);
    await hostile.context().close();
  }
  rmSync(path.join(place, 'packed/0.cells.data.js'));
  const lost = await cellAt('phong', '', fileUrl(place));
  await says(lost, 'main p', /cells\.data\.js cannot be read/);
  await lost.context().close();
});
