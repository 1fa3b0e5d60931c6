// A published gallery in one HTML file: opens from disk without any other file, with its pictures.
import assert from 'node:assert/strict';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { close, launch, lobelia, open, ready, says, scratch } from './browser.mjs';
import { writeFarm } from './farm.mjs';

const directory = scratch(), run = path.join(directory, 'run');
const at = (name) => path.join(directory, name), url = (name) => pathToFileURL(at(name)).href;
const kNames = ['日本語.xml', '中国語.xml', '\u202Etxt.exe', `<b>&"'#50%?`, 'x'.repeat(200)];
let browser;

before(async () => {
  writeFarm(run, { axes: { scene: kNames }, size: 32 });
  lobelia('gallery', 'publish', run, '-o', at('grid.html'));
  browser = await launch();
});
after(() => browser?.close());

const alone = (page, name) => assert.deepEqual([...page.requested].filter((u) => !u.startsWith('data:') && u.split('#')[0] !== url(name)), []);

test('a grid in one file shows its cells and opens each, and asks for nothing else', async () => {
  const page = await open(browser, url('grid.html'));
  await says(page, '.count', /showing 5 of 5 cells/);
  await page.locator('#grid a[href^="#page"]').first().click();
  await says(page, 'h1', /日本語/);
  await ready(page);
  alone(page, 'grid.html');
  await close(page);
});

test('a long name is broken, and a page is no wider than a phone', async () => {
  lobelia('gallery', 'publish', run, '-o', at('long.html'), '--cell', kNames.at(-1));
  const page = await open(browser, url('long.html'), { viewport: { width: 390, height: 844 } });
  await says(page, 'h1', /x{200}/);
  await ready(page);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await close(page);
});
