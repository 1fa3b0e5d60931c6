// The main paths in Firefox ESR.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { clickStage, fileUrl, hashOf, lobelia, scratch, serve } from './browser.mjs';
import { encode, ours, writeFarm } from './farm.mjs';
import { close, launchFirefox, open, press, saved, says, seen, textOf } from './firefox.mjs';
import { writeStudies } from './studies.mjs';

const kSize = 64, kCell = 'cells/phong-16/index.html', kPhone = { width: 390, height: 844 };
const directory = scratch(), run = path.join(directory, 'run'), site = path.join(directory, 'site'), packed = path.join(directory, 'packed'), downloads = path.join(directory, 'downloads');
let browser, server;

before(async () => {
  mkdirSync(downloads);
  writeFarm(run, { axes: { model: ['phong', 'blinn'], exponent: ['16', '128'] }, size: kSize, cell: (i) => (i === 3 ? { status: 'differs' } : {}) });
  writeStudies(run, '<img src=x onerror=alert(1)>');
  lobelia('gallery', run, '-o', site);
  lobelia('gallery', run, '-o', packed, '--metrics-only', '--packed');
  [browser, server] = await Promise.all([launchFirefox(downloads), serve(site)]);
});
after(async () => { await browser?.close(); await server?.stop(); });

const isReady = (page, count = 2) => page.waitForFunction((n) => Number(document.querySelector('.stage')?.dataset.ready) >= n, { polling: 50 }, count);
const near = (found, wanted) => found.forEach((v, i) => assert.ok(Math.abs(v - wanted[i]) <= 6, `${found} is not ${wanted}`));
/** Where the stage has pixel (36, 26) of a whole picture: beside the mark on the pixel that differs most. */
const beside = (page) => page.$eval('.stage', (stage, size) => {
  const { width, height } = stage.getBoundingClientRect(), zoom = Math.min(width, height) / size;
  return [0.5 + (36.5 - size / 2) * zoom / width, 0.5 + (26.5 - size / 2) * zoom / height];
}, kSize);
const fits = (page) => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
/** Middle of the stage in the window. */
async function middleOf(page) {
  const stage = await page.$('.stage');
  await stage.scrollIntoView();
  return page.$eval('.stage', (element) => { const box = element.getBoundingClientRect(); return [box.x + box.width / 2 + 2, box.y + box.height / 2 + 2]; });
}

for (const from of ['file', 'server']) {
  const address = (name) => (from === 'file' ? fileUrl(site) : server.url) + name;

  test(`the index shows a pair, findings and the grid, and Find narrows it, from a ${from}`, async () => {
    const page = await open(browser, address('index.html'));
    await page.waitForSelector('.grid .cell');
    assert.equal(await textOf(page, '.count'), 'showing 4 of 4 cells');
    assert.ok((await page.$$('.findings li')).length >= 3);
    await page.waitForFunction(() => [...document.querySelectorAll('.pair img, .cell img')].every((i) => i.complete && i.naturalWidth > 1));
    assert.ok((await page.$$('.pair img')).length >= 2, 'a picture and its difference');
    await page.type('#find', 'blinn 128');
    await says(page, '.count', /showing 1 of 4 cells/);
    await page.click('.cell > a');
    await isReady(page);
    await says(page, 'h1', /blinn/);
    await close(page);
  });

  test(`a cell paints the float values and tells them, flips and zooms, from a ${from}`, async () => {
    const page = await open(browser, address(kCell + '#mode=flip&shown=a&ev=-1&z=fit'));
    await isReady(page);
    const [bright, dark] = await seen(page, [await beside(page), [0.03, 0.97]]);
    near(bright, ours(36, 26, kSize).map((v) => encode(v / 2)));
    assert.ok(Math.max(...dark) < 40, String(dark));
    const first = await textOf(page, '.tags'), place = await middleOf(page);
    await clickStage(page, ...place);
    await page.waitForFunction((words) => document.querySelector('.tags').textContent !== words, {}, first);
    await page.keyboard.press('f');
    await page.waitForFunction((words) => document.querySelector('.tags').textContent === words, {}, first);
    await page.mouse.move(...place);
    await says(page, '.where', /Pixel \(32, 32\)/);
    await page.waitForFunction(() => /\d/.test(document.querySelector('.pixel-values tbody td')?.textContent ?? ''));
    const shown = Number(await textOf(page, '.pixel-values tbody td')), red = ours(32, 32, kSize)[0];
    assert.ok(Math.abs(shown / red - 1) < 1e-3, `${shown} is not ${red}`);
    await page.focus('.stage');
    await page.mouse.wheel({ deltaY: -240 });
    await page.waitForFunction(() => location.hash.includes('z='));
    await page.mouse.move(place[0] + 1, place[1] + 1);
    await says(page, '.where', /Pixel \(32, 32\)/);
    const zoom = Number((await hashOf(page)).z);
    await page.keyboard.press('+');
    assert.ok(Math.abs(Number((await hashOf(page)).z) / zoom - 2) < 1e-3);
    for (const mode of ['l', 's', 'd']) await page.keyboard.press(mode);
    await says(page, '.tags', / − /);
    await close(page);
  });

  test(`every page of a study opens without a complaint, on a desk and on a phone, from a ${from}`, async () => {
    for (const name of ['explorer', 'stability', 'paper', 'cost', 'search'])
      for (const size of [{}, kPhone]) {
        const page = await open(browser, address(name + '.html'), size);
        await page.waitForSelector('main svg.chart');
        assert.ok(await fits(page), `${name} is wider than the screen`);
        await close(page);
      }
  });
}

test('a cell of a packed site opens, with its pictures', async () => {
  const page = await open(browser, fileUrl(packed) + 'index.html');
  await page.waitForFunction(() => { const all = [...document.querySelectorAll('.cell img')]; return all.length > 0 && all.every((i) => i.complete && i.naturalWidth > 1); });
  await page.click('.cell > a');
  await page.waitForSelector('.viewer');
  await says(page, 'h1', /phong · exponent 16/);
  await says(page, '.stage-note', /no float pictures/);
  await page.evaluate(() => { location.hash += '&mode=flip&shown=a&z=fit'; });
  await page.waitForFunction(() => document.querySelector('.tags')?.children.length === 1);
  await page.waitForFunction(() => { const c = document.querySelector('.stage canvas'), { data } = c.getContext('2d').getImageData(c.width / 2, Math.floor(c.height / 3), 1, 1); return data[0] > 200; });
  await close(page);
});

test('the button Figure saves a picture and numbers', async () => {
  const page = await open(browser, fileUrl(site) + kCell + '#a=lobelia&b=povray&mode=diff');
  await isReady(page);
  await press(page, 'Figure: what the viewer shows');
  await page.waitForSelector('dialog');
  const png = await saved(downloads, () => press(page, 'PNG'));
  assert.equal(png.name, 'phong-16-povray-difference.png');
  assert.equal(png.bytes.toString('latin1', 1, 4), 'PNG');
  const csv = await saved(downloads, async () => { await page.click('::-p-xpath(//dialog//button[starts-with(normalize-space(), "CSV")])'); });
  assert.match(csv.bytes.toString(), /^x,y,lobelia\.r,/);
  await close(page);
});
