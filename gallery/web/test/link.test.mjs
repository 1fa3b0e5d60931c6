// What the link of a cell's page says.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { close, hashOf, ready, says } from './browser.mjs';
import { cellSite } from './cell_site.mjs';

const { cellPage } = cellSite();

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
