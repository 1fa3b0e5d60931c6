// The page of a cell, from file:// and from a server.
import assert from 'node:assert/strict';
import { readFileSync, statSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { close, fileUrl, hashOf, lobelia, open, ready, requireAccessible, says, seenAt, serve } from './browser.mjs';
import { cellSite, kCell, middle, near } from './cell_site.mjs';
import { encode, errorOf, ours, writeFarm } from './farm.mjs';

const kSize = 64, here = cellSite({ size: kSize }), { directory, run, site, cellPage } = here;
let server;
before(async () => { server = await serve(site); });
after(() => server?.stop());

for (const from of ['file', 'server']) {
  test(`opens from a ${from} without a complaint, and shows the float values of a pixel`, async () => {
    const page = await open(here.browser, (from === 'file' ? fileUrl(site) : server.url) + kCell);
    await ready(page);
    const stage = page.locator('.stage');
    await says(page, '.where', /^Pixel \(\d+, \d+\), where they differ most$/);
    await stage.hover({ position: await middle(stage) });
    await stage.focus();
    await page.keyboard.press('ArrowLeft');
    await says(page, '.where', /Pixel \(31, 32\)/);
    await says(page, '.pixel-values tbody td', /\d/);
    const red = ours(31, 32, kSize)[0];
    const shown = Number((await page.locator('.pixel-values tbody tr').first().locator('td').first().textContent()).replace('−', '-'));
    assert.ok(Math.abs(shown / red - 1) < 1e-3, `${shown} is not ${red}`);
    await close(page);
  });
}

test('the policy of a page lets nothing in from elsewhere, and runs no text as code', async () => {
  for (const base of [fileUrl(site), server.url]) {
    const page = await open(here.browser, base + kCell);
    const [blocked, ran] = await page.evaluate(async () => {
      const seen = new Set(), add = (tag, properties) => document.head.append(Object.assign(document.createElement(tag), properties));
      document.addEventListener('securitypolicyviolation', (event) => seen.add(event.effectiveDirective));
      const elsewhere = 'http://127.0.0.1:9/';
      await fetch(elsewhere).catch(() => {});
      add('img', { src: elsewhere });
      add('script', { src: elsewhere });
      add('link', { rel: 'stylesheet', href: elsewhere });
      add('script', { textContent: 'globalThis.ran = 1' });
      const link = Object.assign(document.createElement('a'), { href: 'javascript:globalThis.ran = 2' });
      document.body.append(link);
      link.click();
      const wait = (ms) => new Promise((done) => setTimeout(done, ms));
      // The browser tells of them when it comes to it: for ten minutes at most. Then of any further ones.
      for (let i = 0; i < 30_000 && seen.size < 4; ++i) await wait(20);
      await wait(300);
      return [[...seen].sort(), globalThis.ran];
    });
    assert.deepEqual(blocked, ['connect-src', 'img-src', 'script-src-elem', 'style-src-elem']);
    assert.equal(ran, undefined);
    await page.context().close();
  }
});

test('a difference of two parts in a million is read to more digits than half floats have', async () => {
  const page = await cellPage('#a=povray&b=lobelia&mode=diff', 2);
  await page.locator('.stage').hover({ position: await middle(page.locator('.stage')) });
  await page.locator('.stage').focus();
  await page.keyboard.press('ArrowRight');
  await says(page, '.where', /Pixel \(33, 32\)/);
  const cell = page.locator('.pixel-values tr.sum td').first();
  await page.waitForFunction(() => /\d/.test(document.querySelector('.pixel-values tr.sum td')?.textContent ?? ''));
  const wanted = Math.fround(ours(33, 32, kSize)[0] * (1 + errorOf.povray)) - ours(33, 32, kSize)[0];
  const shown = Number((await cell.textContent()).replace(/−/g, '-'));
  assert.ok(Math.abs(shown / wanted - 1) < 0.01, `${shown} is not ${wanted}`);
  await close(page);
});

test('exposure acts on the linear values', async () => {
  const page = await cellPage('#mode=flip&ev=-1');
  const peak = [0.5, 1 / 3];  // near enough to the brightest pixel
  const value = ours(32, 21, kSize);
  near(await seenAt(page, ...peak), value.map((v) => encode(v / 2)), 4);
  await page.keyboard.press('E');  // half a stop darker
  near(await seenAt(page, ...peak), value.map((v) => encode(v * 2 ** -1.5)), 4);
  assert.equal((await hashOf(page)).ev, '-1.5');
  await close(page);
});

test('the divider shows one picture left of it and the other right of it', async () => {
  // At an exposure where a thousandth cannot be seen nothing moves; so as false difference: the sides are named.
  const page = await cellPage('#mode=slide');
  const range = page.getByRole('slider', { name: 'Divider' });
  await range.focus();
  await page.keyboard.press('Home');
  assert.equal((await hashOf(page)).split, '0');
  await page.keyboard.press('End');
  assert.equal((await hashOf(page)).split, '100');
  const box = await page.locator('.stage').boundingBox();
  await page.mouse.move(box.x + box.width - 2, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 4, box.y + 200);
  await page.mouse.up();
  assert.ok(Math.abs(Number((await hashOf(page)).split) - 25) < 1);
  await close(page);
});

test('a difference has the scale that its legend prints, and false colour tells small ones apart', async () => {
  const page = await cellPage('#a=blender&b=lobelia&mode=diff');
  const [wide] = await seenAt(page, 0.5, 1 / 3);
  assert.ok(wide > 240, `the largest difference is white: ${wide}`);
  await says(page, '.legend-bar', /0\.0025 = 0\.1 % of the peak/);
  await page.keyboard.press('E');
  await page.keyboard.press('E');  // a stop down: half as bright, and white stands for twice as much
  const [half] = await seenAt(page, 0.5, 1 / 3);
  assert.ok(half > 120 && half < 135, String(half));
  await says(page, '.legend-bar', /0\.005 =/);
  await page.getByRole('checkbox', { name: 'False colour' }).check();
  const colour = await seenAt(page, 0.5, 1 / 3);
  assert.ok(colour[0] > 200 && colour[2] < 190, `inferno, near its top: ${colour}`);
  await close(page);
});

test('a map by a metric has the largest value that the metric has, and is dark where nobody notices a difference', async () => {
  const cell = path.join(run, path.dirname(kCell)), record = path.join(directory, 'compared.json');
  lobelia('compare', path.join(cell, 'lobelia.exr'), path.join(cell, 'blender.exr'), '--exposure', '-1.3', '--pixels-per-degree', '67', '--json', record);
  const { metrics } = JSON.parse(readFileSync(record));
  const page = await cellPage('#a=lobelia&b=blender&mode=diff&measure=ciede2000');
  const largest = async (title) => {
    await says(page, '.legend-bar', new RegExp(`${title}: .*the largest is [0-9]`));
    return Number(/the largest is ([0-9.e-]+)/.exec(await page.locator('.legend-bar').textContent())[1]);
  };
  const isNear = (seen, wanted) => assert.ok(Math.abs(seen / wanted - 1) < 0.01, `${seen} is not ${wanted}`);
  isNear(await largest('CIEDE2000'), metrics['ciede2000.max']);
  const value = page.locator('.pixel-values tr.sum').filter({ hasText: 'CIEDE2000' }).locator('td');
  isNear(Number(await value.textContent()), metrics['ciede2000.max']);  // the cursor is where they differ most
  assert.ok(metrics['ciede2000.max'] < 0.2, 'too little to be noticed');
  const dark = await seenAt(page, 0.5, 1 / 3);
  assert.ok(Math.max(...dark) < 100, String(dark));
  for (let i = 0; i < 20; ++i) await page.keyboard.press('e');  // ten stops
  near(await seenAt(page, 0.5, 1 / 3), [252, 253, 191]);  // the top of magma
  for (const [id, title] of [['delta_e_itp', 'delta E ITP'], ['flip.ldr', 'LDR-FLIP, 0 to 1']]) {
    await page.getByLabel('Measure').selectOption({ label: title });
    assert.equal((await hashOf(page)).measure, id);
    isNear(await largest(title), metrics[`${id}.max`]);
  }
  await page.getByLabel('First').selectOption('povray');
  await says(page, '.legend-bar', /LDR-FLIP, 0 to 1 was made of ours and each engine/);
  await close(page);
});

test('beside a map is the histogram of its values, weighed as FLIP’s tool does, on the map’s own scale', async () => {
  const bad = path.join(directory, 'bad'), badSite = path.join(directory, 'bad-site');
  writeFarm(bad, { axes: { model: ['phong'] }, size: kSize, noise: 0.3 });
  lobelia('gallery', bad, '-o', badSite);
  const page = await open(here.browser, fileUrl(badSite) + 'cells/phong/index.html#mode=diff&a=lobelia&b=blender', { acceptDownloads: true });
  await ready(page);
  const histogram = page.locator('.map-histogram'), numbers = (words) => words.match(/\d+(?:\.\d+)?/g).map(Number);
  assert.equal(await histogram.isVisible(), false, 'a difference of values has none');
  for (const [id, title, top] of [['flip.ldr', 'LDR-FLIP, 0 to 1', 1], ['ciede2000', 'CIEDE2000', 10], ['delta_e_itp', 'delta E ITP', 10]]) {
    await page.evaluate((measure) => { location.hash = `mode=diff&a=lobelia&b=blender&measure=${measure}`; }, id);
    await says(page, '.legend-bar', new RegExp(`^0${top}${title}`));
    await says(page, '.map-histogram h3', new RegExp(title));
    // The same from the values that the figure of the map saves.
    const csv = async (button) => {
      await page.getByRole('button', { name: button }).click();
      const [download] = await Promise.all([page.waitForEvent('download'), page.locator('dialog').getByRole('button', { name: /^CSV/ }).click()]);
      await page.keyboard.press('Escape');
      return readFileSync(await download.path(), 'utf8').trim().split('\n').slice(1).map((line) => line.split(',').map(Number));
    };
    const values = (await csv('Figure: what the viewer shows')).map((row) => row.at(-1)).sort((a, b) => a - b), sum = values.reduce((a, b) => a + b);
    assert.equal(values.length, kSize * kSize);
    const quartile = (share) => { let below = 0; return values.find((v) => (below += v) >= share * sum); };
    const [mean, median, first, third, least, most] = numbers(await histogram.locator('figcaption').textContent());
    const near3 = (a, b, what) => assert.ok(Math.abs(a - b) <= 6e-3 * b, `${id}, ${what}: ${a}, not ${b}`);
    near3(mean, sum / values.length, 'mean');
    [first, median, third].forEach((one, i) => near3(one, quartile((i + 1) / 4), `quartile ${i + 1}`));
    near3(least, values[0], 'least');
    near3(most, values.at(-1), 'most');
    assert.deepEqual((await histogram.locator('svg .band-label').allTextContents()).slice(0, 2), ['min', 'mean']);
    const bars = await csv('Figure: Values of the map');
    assert.equal(bars.length, 100);
    assert.ok(Math.abs(bars.reduce((all, [, y]) => all + y, 0) / (sum * 1e6 / values.length) - 1) < 1e-3, 'the bars have all values');
  }
  await requireAccessible(page, 'a map and its histogram');
  await close(page);
});

test('the worst pixel of two pictures is found, and brought into the middle of a zoomed view', async () => {
  const page = await cellPage('#a=blender&b=lobelia&z=20&x=5&y=5');
  await page.keyboard.press('w');
  // The brightest pixel: each is off by the same share.
  await says(page, '.where', /Pixel \(32, 21\), where they differ most/);
  const hash = await hashOf(page);
  assert.deepEqual([hash.x, hash.y], ['32.5', '21.5']);
  await close(page);
});

test('the highlight is drawn linear, logarithmic and as a ratio, with zones and values', async () => {
  const page = await cellPage();
  const figure = page.locator('.chart-figure.scripted-only');
  assert.equal(await figure.locator('.band-label').count(), 3);
  for (const [scale, words] of [['log', /radiance/], ['ratio', /engine \/ formula/], ['error', /formula/]]) {
    await page.locator('#profile-scale').selectOption(scale);
    assert.equal((await hashOf(page)).scale, scale);
    assert.match(await figure.locator('svg.interactive').textContent(), words);
    assert.ok(await figure.locator('path.series').count() >= 2);
  }
  const series = figure.getByRole('checkbox').first(), lines = await figure.locator('path.series').count();
  await series.uncheck();
  assert.equal(await figure.locator('path.series').count(), lines - 1);
  await close(page);
});

test('without script every picture and number is there', async () => {
  const page = await open(here.browser, fileUrl(site) + kCell, { javaScriptEnabled: false });
  assert.equal(await page.locator('section.pictures img').count(), 7);
  assert.ok(await page.locator('section.pictures img').first().isVisible());
  assert.match(await page.locator('table.metrics').textContent(), /Largest difference, of the peak/);
  assert.ok(await page.locator('.chart-figure svg').first().isVisible());
  await close(page);
});

test('on paper the pictures are there, and the controls are not', async () => {
  const page = await cellPage();
  await page.emulateMedia({ media: 'print' });
  assert.ok(await page.locator('section.pictures').isVisible());
  assert.ok(!await page.locator('.viewer').isVisible());
  await close(page);
});

test('axe finds nothing, in light, in dark and in forced colours, at rest and with everything open', async () => {
  for (const colours of [{ colorScheme: 'light' }, { colorScheme: 'dark' }, { forcedColors: 'active' }]) {
    const page = await open(here.browser, fileUrl(site) + kCell + '#mode=diff&colour=false&line=3,3,40,40&scale=ratio', colours);
    await ready(page);
    await page.locator('.keys summary').click();
    await requireAccessible(page, `cell in ${JSON.stringify(colours)}`);
    const [on, off] = await Promise.all(['true', 'false'].map((is) => page.locator(`button[aria-pressed=${is}]`).first().evaluate((e) => getComputedStyle(e).backgroundColor)));
    assert.notEqual(on, off, 'what is pressed looks pressed');
    if (colours.forcedColors) {
      const chosen = await page.evaluate(() => {
        const e = document.body.appendChild(document.createElement('i'));
        Object.assign(e.style, { background: 'Highlight', forcedColorAdjust: 'none' });
        const colour = getComputedStyle(e).backgroundColor;
        e.remove();
        return colour;
      });
      assert.equal(on, chosen, 'what is pressed has the system’s colour of what is chosen');
    }
    await close(page);
  }
});

test('a cell of 512 x 512 pixels of coloured noise weighs less than a megabyte with everything that its page can load', async () => {
  const big = path.join(directory, 'big'), bigSite = path.join(directory, 'big-site');
  writeFarm(big, { axes: { model: ['phong'] }, size: 512, noise: 0.3 });
  lobelia('gallery', big, '-o', bigSite);
  const page = await open(here.browser, fileUrl(bigSite) + 'cells/phong/index.html#mode=side&a=lobelia&b=blender');
  await ready(page);
  await page.locator('.stage').hover();  // asks for the other engines' values
  await ready(page, 4);
  for (const [id, title] of [['ciede2000', 'CIEDE2000'], ['delta_e_itp', 'delta E ITP'], ['flip.ldr', 'LDR-FLIP']])
    for (const [engine, name] of [['analytic', 'Analytic'], ['povray', 'POV-Ray'], ['blender', 'Blender']]) {
      await page.evaluate(([b, measure]) => { location.hash = `#mode=diff&a=lobelia&b=${b}&measure=${measure}`; }, [engine, id]);
      await says(page, '.tags', new RegExp(name));
      await says(page, '.legend-bar', new RegExp(`${title}.*the largest is`));
    }
  // What an <img> of the page without script shows is loaded too, wherever it stands.
  await page.evaluate(() => Promise.all([...document.images].map((image) => { image.loading = 'eager'; return image.decode(); })));
  const files = [...page.requested].filter((url) => url.startsWith('file:')).map((url) => url.replace(/#.*/, ''));
  assert.ok(files.length >= 24, files.join(' '));
  const total = files.reduce((sum, url) => sum + statSync(fileURLToPath(url)).size, 0);
  assert.ok(total < 1e6, `${total} bytes`);
  await close(page);
});

test('what is under the rounding of a half float is 0, and no value has more digits than were stored', async () => {
  const page = await cellPage('#at=0,63', 2);  // 5e-12, where a step is 7e-12
  await page.locator('.stage').hover({ position: { x: 5, y: 5 } });  // beside the picture: asks for all engines
  await ready(page, 4);
  await page.mouse.move(0, 0);
  await page.reload();
  await ready(page, 4);
  await says(page, '.where', /Pixel \(0, 63\)/);
  await page.waitForFunction(() => !document.querySelector('.pixel-values').textContent.includes('…'));
  const rows = await page.locator('.pixel-values tbody tr:not(.sum)').allTextContents();
  assert.equal(rows.length, 4);
  for (const row of rows) assert.match(row, /^\D+(0|[1-9]e−1[12])(0|[1-9]e−1[12])(0|[1-9]e−1[12])$/);
  await close(page);
});

test('a damaged float picture is told, and the page goes on', async () => {
  writeFileSync(path.join(site, 'cells/blinn-16/povray.float.js'), "lobelia('something else','{}');");
  const page = await open(here.browser, fileUrl(site) + 'cells/blinn-16/index.html');
  await page.getByText('holds no "float picture"').waitFor();
  await close(page);
});
