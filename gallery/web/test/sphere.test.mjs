// The explorer's sphere: its pixels against the analytic reference, its shader against `lobelia export`, its controls, and
// what it does without WebGL 2.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { address, close, fileUrl, hashOf, launch, lobelia, open, requireAccessible, says, scratch } from './browser.mjs';
import { redOf } from './exr.mjs';
import { writeFarm } from './farm.mjs';

const directory = scratch(), run = path.join(directory, 'run'), site = path.join(directory, 'site');
const kBound = 1e-5;  // of the peak
const kExponents = [1, 7.3, 64, 431, 1000];
const kLight = [-40, 30], kCamera = [20, -10], kSize = 256;
const view = `px=${kSize}&light=${kLight}&camera=${kCamera}`;
let browser, tables;

before(async () => {
  writeFarm(run, { axes: { model: ['phong'] }, size: 8, cell: () => ({}) });
  mkdirSync(path.join(run, 'explorer'));
  lobelia('models', '--tables', path.join(run, 'explorer/tables.json'));
  tables = JSON.parse(readFileSync(path.join(run, 'explorer/tables.json'), 'utf8'));
  lobelia('gallery', run, '-o', site);
  // The scene that the page shows: the light comes from where the camera's angles put it.
  const at = ([right, up]) => [Math.sin(right) * Math.cos(up), Math.sin(up), Math.cos(right) * Math.cos(up)];
  const radians = (angles) => angles.map((a) => a * Math.PI / 180);
  writeFileSync(path.join(directory, 'scene.xml'), `<scene version="1">
    <sensor type="perspective"><float name="fov" value="28"/>
      <transform name="to_world"><lookat origin="${at(radians(kCamera)).map((v) => 5 * v)}" target="0, 0, 0" up="0, 1, 0"/></transform>
      <film type="hdrfilm"><integer name="width" value="${kSize}"/><integer name="height" value="${kSize}"/></film></sensor>
    <emitter type="directional"><vector name="direction" value="${at(radians(kLight)).map((v) => -v)}"/><rgb name="irradiance" value="1"/></emitter>
    <bsdf type="phong_rdf" id="highlight"><string name="lobe" value="cosine"/><float name="exponent" value="64"/></bsdf>
    <shape type="sphere"><point name="center" value="0, 0, 0"/><float name="radius" value="1"/><ref id="highlight"/></shape></scene>`);
  browser = await launch();
});
after(async () => { await browser?.close(); });

const explorer = (hash = '', options = {}, from = browser) => open(from, `${fileUrl(site)}explorer.html#${hash}`, options);

async function floatsOf(page, side = 'A') {
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: `Save float picture ${side}` }).click()]);
  const bytes = readFileSync(await download.path()), head = `Pf\n${kSize} ${kSize}\n-1.0\n`;
  assert.equal(bytes.toString('latin1', 0, head.length), head);
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset + head.length, bytes.byteOffset + bytes.length));
}

/** The largest difference from the analytic reference, of its peak. */
function errorOf(pixels, { model, lobe }, n, normalisation) {
  const file = path.join(directory, 'analytic.exr');
  lobelia('reference', path.join(directory, 'scene.xml'), '--engine', 'analytic', '-q', '-o', file,
    '--model', model, '--lobe', lobe, '--normalisation', normalisation, '--exponent', String(n));
  const truth = redOf(file);
  assert.equal(pixels.length, truth.length);
  let peak = 0, most = 0;
  truth.forEach((v, i) => { peak = Math.max(peak, v); most = Math.max(most, Math.abs(v - pixels[i])); });
  assert.ok(peak > 0);
  return most / peak;
}

/** Shows these two and waits for them. */
async function showPair(page, a, b, more = '') {
  const hash = `${view}&model=${a.model}&lobe=${a.lobe}&n=${a.n}&norm=${a.norm}&model2=${b.model}&lobe2=${b.lobe}&n2=${b.n}&norm2=${b.norm}${more}`;
  await page.evaluate((text) => { location.hash = text; }, hash);
  await page.waitForFunction((all) => all.every(([id, value]) => document.getElementById(id).value === value),
    [['model', a.model], ['lobe', a.lobe], ['n', String(a.n)], ['norm', a.norm], ['model2', b.model], ['lobe2', b.lobe], ['n2', String(b.n)], ['norm2', b.norm]]);
}

test('every pixel of every highlight is within 1e-5 of the peak of the analytic reference', async () => {
  const page = await explorer(view);
  const all = tables.highlights.flatMap((h) => ['exact', ...(h.paper ? ['paper'] : [])].map((norm) => ({ ...h, norm })));
  all.forEach((one, i) => { one.n = Math.max(one.norm === 'paper' ? 16 : 1, kExponents[i % kExponents.length]); });  // the paper's begin at 16
  for (let i = 0; i < all.length; i += 2) {
    const pair = [all[i], all[(i + 1) % all.length]];
    await showPair(page, ...pair);
    for (const [k, one] of pair.entries()) {
      const error = errorOf(await floatsOf(page, 'AB'[k]), one, one.n, one.norm);
      assert.ok(error <= kBound, `${one.model} ${one.lobe} ${one.norm} at ${one.n}: ${error}`);
    }
  }
  assert.equal(await page.locator('.sphere .stage-note').textContent(), '');
  await close(page);
});

test('the shader on the page is what lobelia export writes, and can be copied', async () => {
  const page = await explorer('', { permissions: ['clipboard-read', 'clipboard-write'] });
  for (const [model, lobe, norm] of [['modified_phong', 'cs16', 'paper'], ['microfacet_smith', 'pk3.4', 'exact'], ['blinn_phong_rdf', 'cosine', 'exact']]) {
    const one = { model, lobe, norm, n: 20 };
    await showPair(page, one, one);
    const text = lobelia('export', '--language', 'glsl', model, '--lobe', lobe, '--normalisation', norm, '--coefficient', 'argument');
    assert.equal(await page.locator('.choice-A pre').textContent(), text);
    await page.getByRole('button', { name: 'Copy shader B' }).click();
    await says(page, '#announcer', /is copied/);
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), text);
  }
  await close(page);
  const parts = tables.shaderParts;
  for (const { model, lobe, shader } of tables.highlights.filter((_, i) => i % 20 === 0))
    assert.equal(shader.map((part) => parts[part]).join(''), lobelia('export', '--language', 'glsl', model, '--lobe', lobe, '--coefficient', 'argument'));
});

test('pointer, touch and keys turn light and camera and move the divider, and the link has all of it', async () => {
  const page = await explorer('wipe=80', { hasTouch: true }), stage = page.locator('.sphere-stage');
  await stage.scrollIntoViewIfNeeded();
  const box = await stage.boundingBox(), x = box.x + box.width / 2, y = box.y + box.height / 2;
  const drag = async (fromX, dx, dy) => {
    await page.mouse.move(fromX, y);
    await page.mouse.down();
    await page.mouse.move(fromX + dx, y + dy, { steps: 5 });
    await page.mouse.up();
  };
  await drag(x, box.width / 6, 0);
  assert.deepEqual(await hashOf(page), { wipe: '80', light: '-10,30' });
  await page.keyboard.down('Shift');
  await drag(x, 0, box.width / 9);
  await page.keyboard.up('Shift');
  assert.equal((await hashOf(page)).camera, '0,20');
  await drag(box.x + 0.8 * box.width, -box.width / 2, 0);
  assert.ok(Math.abs(Number((await hashOf(page)).wipe) - 30) <= 0.5);
  await page.locator('#sphere-drag').selectOption('camera');
  const client = await page.context().newCDPSession(page), touch = (type, points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  await touch('touchStart', [{ x, y }]);
  await touch('touchMove', [{ x: x - box.width / 18, y }]);
  await touch('touchEnd', []);
  await says(page, '.sphere-numbers', /Camera 10° right, 20° up/);
  await page.locator('#sphere-drag').selectOption('light');
  await stage.focus();
  await page.keyboard.press('ArrowUp');
  await says(page, '#announcer', /Light 10° left, 35° up/);
  await page.keyboard.press('Shift+ArrowLeft');
  await says(page, '#announcer', /Camera 5° right, 20° up/);
  const hash = await hashOf(page), again = await open(browser, await address(page));
  assert.deepEqual({ ...hash, wipe: '' }, { wipe: '', light: '-10,35', camera: '5,20' });
  await says(again, '.sphere-numbers', /Light 10° left, 35° up. Camera 5° right, 20° up/);
  await close(again);
  await page.getByRole('button', { name: 'Reset' }).click();
  assert.deepEqual(await hashOf(page), { top: '' });
  await close(page);
});

test('the largest difference is that of the float pixels', async () => {
  const page = await explorer(), a = { model: 'phong_rdf', lobe: 'ggx', norm: 'exact', n: 50 }, b = { ...a, lobe: 'schlick', n: 300 };
  await showPair(page, a, b, '&show=difference');
  const [first, second] = [await floatsOf(page, 'A'), await floatsOf(page, 'B')];
  const largest = first.reduce((most, v, i) => (Math.abs(v - second[i]) > Math.abs(most) ? v - second[i] : most), 0);
  const text = await page.locator('.sphere-numbers').textContent(), said = Number(/A − B: ([−\d.]+),/.exec(text)[1].replace('−', '-'));
  assert.ok(Math.abs(said / largest - 1) < 5e-3, `${text}, not ${largest}`);
  await requireAccessible(page, 'difference');
  await close(page);
});

test('without WebGL 2 there is no sphere, and the page says so', async () => {
  const without = await launch(['--disable-3d-apis']);
  try {
    const page = await explorer(view, {}, without);
    await says(page, '.sphere .stage-note', /There is no picture/);
    assert.ok(await page.locator('.explorer svg.interactive path.series').count() > 0, 'the curves are there');
    await requireAccessible(page, 'without WebGL 2');
    await close(page);
  } finally {
    await without.close();
  }
});

test('a cell opens in the explorer with its parameters', async () => {
  const page = await open(browser, `${fileUrl(site)}cells/phong/index.html`);
  await page.getByRole('link', { name: 'Open in the explorer' }).click();
  await page.waitForFunction(() => document.querySelector('#n')?.value === '16');
  for (const [id, value] of [['model', 'phong_rdf'], ['lobe', 'cosine'], ['norm', 'exact']]) assert.equal(await page.locator(`#${id}`).inputValue(), value);
  assert.equal(await page.locator('#two').isChecked(), false);
  await close(page);
});
