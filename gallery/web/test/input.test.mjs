// A reader's hand on the page of a cell: keys, mouse and fingers; and what the link of the page says.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { address, clickStage, close, hashOf, open, ready, requireAccessible, says, seenAt } from './browser.mjs';
import { cellSite, middle, near } from './cell_site.mjs';

const here = cellSite({ size: 64 }), { cellPage } = here;

test('keys choose pictures and ways to compare, and the link says which', async () => {
  const page = await cellPage();
  await page.keyboard.press('4');
  await page.keyboard.press('Shift+Digit2');
  await page.keyboard.press('d');
  let hash = await hashOf(page);
  assert.deepEqual([hash.a, hash.b, hash.mode], ['blender', 'analytic', 'diff']);
  await says(page, '.tags', /^Blender Cycles − Analytic$/);
  await page.keyboard.press('x');
  await page.keyboard.press('s');
  await says(page, '.tags', /^AnalyticBlender Cycles$/);
  await page.keyboard.press('f');
  await says(page, '.tags', /^Analytic$/);
  await page.keyboard.press('f');
  await says(page, '.tags', /^Blender Cycles$/);
  // The same again from the link alone.
  const again = await open(here.browser, await address(page));
  await ready(again);
  await says(again, '.tags', /^Blender Cycles$/);
  await close(again);
  await close(page);
});

test('letters typed into a field are no commands', async () => {
  const page = await cellPage();
  await page.locator('select').first().focus();
  await page.keyboard.press('d');
  assert.equal((await hashOf(page)).mode, undefined);
  await close(page);
});

test('zoom and pan go down to the pixel, together in both pictures', async () => {
  const page = await cellPage('#mode=side');
  await page.locator('.stage').focus();
  for (let i = 0; i < 12; ++i) await page.keyboard.press('+');
  const hash = await hashOf(page);
  assert.ok(Number(hash.z) >= 32, `zoom ${hash.z}`);
  await page.keyboard.press('Shift+ArrowRight');
  assert.ok(Number((await hashOf(page)).x) > Number(hash.x));
  const left = await seenAt(page, 0.1, 0.5), right = await seenAt(page, 0.6, 0.5);
  near(left, right, 3);
  await page.keyboard.press('0');
  assert.equal((await hashOf(page)).z, undefined);
  await close(page);
});

test('the wheel zooms about the cursor, and a drag takes the picture along', async () => {
  const page = await cellPage('#mode=side');
  await page.locator('.stage').focus();  // else the wheel scrolls the page
  const box = await page.locator('.stage').boundingBox(), x = box.x + 0.35 * box.width, y = box.y + 0.3 * box.height;
  const pixelAt = async (dx, dy) => {
    await page.mouse.move(x + dx + 30, y + dy);
    await page.mouse.move(x + dx, y + dy);
    await says(page, '.where', /^Pixel \(\d+, \d+\)$/);
    return (await page.locator('.where').textContent()).match(/\d+/g).map(Number);
  };
  const pixel = await pixelAt(0, 0), zoom = Number((await hashOf(page)).z ?? 0);
  await page.mouse.wheel(0, -480);
  await page.waitForFunction((before) => Number(new URLSearchParams(location.hash.slice(1)).get('z')) > before, zoom);
  near(await pixelAt(0, 0), pixel, 1);
  await page.mouse.down();
  await page.mouse.move(x + 30, y + 20);
  await page.mouse.move(x + 60, y + 40);
  await page.mouse.up();
  near(await pixelAt(60, 40), pixel, 1);
  await close(page);
});

test('the pictures are within the first screen of a phone, and a link skips to them', async () => {
  const page = await cellPage('', 2, { viewport: { width: 390, height: 844 }, hasTouch: true });
  const { y, height } = await page.locator('.stage').boundingBox();
  assert.ok(y + height <= 844, `${y} + ${height}`);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await requireAccessible(page, 'a cell on a phone');
  await page.setViewportSize({ width: 360, height: 640 });
  const small = await page.locator('.stage').boundingBox();
  assert.ok(small.y + small.height <= 640, `${small.y} + ${small.height} on a small phone`);
  await page.getByRole('link', { name: 'Skip to the pictures' }).focus();
  await page.keyboard.press('Enter');
  assert.equal(await page.evaluate(() => document.activeElement.className), 'stage');
  await close(page);
});

test('two pictures are flipped by a click, while a press lasts, and by a timer', async () => {
  const page = await cellPage('#mode=flip&shown=a');
  const shown = () => page.locator('.tags').textContent(), first = await shown();
  const box = await page.locator('.stage').boundingBox();
  const middle = [box.x + box.width / 2, box.y + box.height / 2];
  await clickStage(page, ...middle);
  await page.waitForFunction((words) => document.querySelector('.tags').textContent !== words, first);
  const second = await shown();
  await page.mouse.move(...middle);
  await page.mouse.down();
  await says(page, '.tags', new RegExp(first));
  await page.mouse.up();
  await says(page, '.tags', new RegExp(second));
  await page.mouse.down();
  await page.mouse.move(middle[0] + 40, middle[1]);
  await page.mouse.up();
  await says(page, '.tags', new RegExp(second));
  await page.getByRole('button', { name: 'Blink' }).click();
  for (const words of [first, second, first]) await says(page, '.tags', new RegExp(words));
  await page.keyboard.press('Escape');
  assert.equal(await page.getByRole('button', { name: 'Blink' }).getAttribute('aria-pressed'), 'false');
  await close(page);
});

test('two fingers zoom, and keep what is under them', async () => {
  const page = await cellPage('', 2, { viewport: { width: 390, height: 844 }, hasTouch: true });
  const session = await page.context().newCDPSession(page), box = await page.locator('.stage').boundingBox();
  const x = box.x + box.width / 2, y = box.y + box.height / 2;
  const touch = (type, apart) => session.send('Input.dispatchTouchEvent', { type, touchPoints: apart ? [{ x, y, id: 1 }, { x: x + apart, y, id: 2 }] : [] });
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x, y, id: 1 }] });
  await touch('touchStart', 40);
  for (const apart of [60, 80]) await touch('touchMove', apart);
  await touch('touchEnd', 0);
  const { z, x: middle } = await hashOf(page);
  assert.ok(Number(z) > 0 && Number.isFinite(Number(middle)));
  const wide = Number(z);
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x, y, id: 1 }] });
  await touch('touchStart', 80);
  await touch('touchMove', 40);
  await touch('touchEnd', 0);
  const after = await hashOf(page);
  assert.ok(Math.abs(Number(after.z) / wide - 0.5) < 1e-3, `${after.z} of ${wide}`);
  assert.ok(Math.abs(Number(after.x) - Number(middle)) < 0.1, `${after.x} of ${middle}`);
  await close(page);
});

test('keys go to the next cell and picture, and fill the screen', async () => {
  const page = await cellPage();
  const title = await page.locator('h1').textContent();
  const second = () => page.getByLabel('Second').inputValue(), before = await second();
  await page.keyboard.press('.');
  assert.notEqual(await second(), before);
  await page.keyboard.press(',');
  assert.equal(await second(), before);
  await page.keyboard.press('m');
  await page.waitForFunction(() => document.fullscreenElement?.className === 'stage-column');
  await page.keyboard.press('m');
  await page.waitForFunction(() => !document.fullscreenElement);
  await page.keyboard.press('j');
  await page.waitForFunction((words) => document.querySelector('h1').textContent !== words, title);
  await page.keyboard.press('k');
  await page.waitForFunction((words) => document.querySelector('h1').textContent === words, title);
  await close(page);
});

test('a line drawn across the picture shows its profile', async () => {
  const page = await cellPage('#mode=flip');
  await page.getByRole('button', { name: 'Draw a line' }).click();
  const box = await page.locator('.stage').boundingBox();
  await page.mouse.move(box.x + box.width * 0.4, box.y + box.height * 0.3);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.4, { steps: 4 });
  await page.mouse.up();
  assert.match((await hashOf(page)).line, /^\d+,\d+,\d+,\d+$/);
  const chart = page.locator('.line-box svg.chart.interactive');
  await chart.waitFor();
  assert.equal(await chart.locator('path.series').count(), 2);
  await chart.focus();
  await page.keyboard.press('ArrowRight');
  assert.match(await page.locator('.line-box .readout').textContent(), /at 0: Lobelia \d/);
  await close(page);
});

test('the pixel that was chosen is in the link, and the next cell is seen as this one is', async () => {
  const page = await cellPage('#mode=diff&b=blender&gain=2');
  await page.locator('.stage').focus();
  await page.keyboard.press('w');
  await page.keyboard.press('ArrowRight');
  const { at } = await hashOf(page);
  assert.equal(at, '33,21');
  await page.getByRole('link', { name: '128' }).first().click();
  await page.waitForURL(/phong-128/);
  await ready(page);
  assert.deepEqual(await hashOf(page), { mode: 'diff', b: 'blender', gain: '2', at });
  await says(page, '.where', /Pixel \(33, 21\)/);
  await close(page);
});

test('an exposure beyond the bounds is taken for the nearest that there is, and the label says which', async () => {
  const page = await cellPage('#mode=flip&ev=999');
  await says(page, '.exposure label', /^Exposure 12\.68 stops$/);  // 14 above that of the pictures
  await page.keyboard.press('e');
  assert.ok(Math.abs(Number((await hashOf(page)).ev) - 12.678) < 1e-3);
  await page.keyboard.press('E');
  await says(page, '.exposure label', /^Exposure 12\.18 stops$/);
  await close(page);
});

test('a hash that makes no sense does no harm', async () => {
  const page = await cellPage('#a=<img src=x onerror=alert(1)>&mode=__proto__&z=nan&x=1e999&line=1,2,3&ev=x&measure=constructor&colour=%ff');
  await says(page, '.tags', /^LobeliaPOV-Ray$/);
  await close(page);
});
