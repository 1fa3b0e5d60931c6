// A reader's shader in the explorer: it runs beside the model, the page names the mistakes that `lobelia check-shader`
// names, a link carries it as text, and one that does not end leaves the page alive.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { close, fileUrl, launch, launchToKill, lobelia, open, program, requireAccessible, says, scratch } from './browser.mjs';
import { writeFarm } from './farm.mjs';

const directory = scratch(), run = path.join(directory, 'run'), site = path.join(directory, 'site');
let browser;

const half = 'max(dot(N, normalize(L + V)), 0.0)', mirror = 'max(dot(reflect(-V, N), L), 0.0)', cosine = 'max(dot(N, L), 0.0)';
const shaderOf = (value, language = 'glsl') => (language === 'glsl'
  ? `float highlight(vec3 N, vec3 V, vec3 L, float n)\n{\n    if (dot(N, L) <= 0.0) return 0.0;\n    return ${value};\n}\n`
  : `fn highlight(N: vec3f, V: vec3f, L: vec3f, n: f32) -> f32\n{\n    if (dot(N, L) <= 0.0) { return 0.0; }\n    return ${value};\n}\n`);
const kPi = '3.14159265';
/** A model, and a value that is the same text in both languages. */
const kShaders = [
  ['blinn_phong_ndf', `(n + 1.0) / (8.0 * ${kPi}) * pow(${half}, n) * ${cosine}`],
  ['blinn_phong_ndf', `(n + 1.0) / (2.0 * ${kPi}) * pow(${half}, n) * ${cosine}`],
  ['modified_phong', `(n + 2.0) / 2.0 * pow(${mirror}, n) * ${cosine}`],
  ['modified_phong', `(n + 2.0) / (2.0 * ${kPi}) * pow(${mirror}, n)`],
  ['blinn_phong_heightfield', `(n + 8.0) / (8.0 * ${kPi}) * pow(${half}, n) * ${cosine}`],
  ['modified_phong', `(n + 2.0) / (2.0 * ${kPi}) * pow(${half}, n) * ${cosine}`],
  ['modified_phong', `(n + 2.0) / (2.0 * ${kPi}) * pow(${mirror}, n) * ${cosine} * ${cosine}`],
  ['phong_rdf', `min((n + 1.0) / (2.0 * ${kPi}) * pow(${mirror}, n), 1.0)`],
  ['phong_rdf', '0.0'],
];

before(async () => {
  writeFarm(run, { axes: { model: ['phong'] }, size: 8, cell: () => ({}) });
  mkdirSync(path.join(run, 'explorer'));
  lobelia('models', '--tables', path.join(run, 'explorer/tables.json'));
  lobelia('gallery', run, '-o', site);
  browser = await launch(['--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader']);
});
after(async () => { await browser?.close(); });

const explorer = (hash = '') => open(browser, `${fileUrl(site)}explorer.html#${hash}`);

async function openPanel(page) {
  await page.evaluate(() => { document.querySelector('.choice-own').open = true; });
  return await page.locator('#own-text').count() > 0;
}

/** "passes" or the mistakes' names; a sentence if it does not run. */
async function resultOf(page, text) {
  if (text !== undefined) await page.fill('#own-text', text);
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await page.waitForFunction(() => document.querySelector('.own-verdict') || !['', 'It runs …'].includes(document.querySelector('.own-status').textContent));
  const verdict = page.locator('.own-verdict');
  if (await verdict.count() === 0) return page.locator('.own-status').textContent();
  return await verdict.getAttribute('data-verdict') === 'passes' ? 'passes' : (await page.locator('.own-result code').allTextContents()).join(' ');
}

function programSays(model, text) {
  const file = path.join(directory, 'mine.glsl');
  writeFileSync(file, text);
  const { status, stdout, stderr } = spawnSync(program, ['check-shader', file, '--function', 'highlight', '--model', model, '--no-costs', '--json', '-'], { encoding: 'utf8' });
  if (status === 5) return { missing: stderr };
  assert.ok(status === 0 || status === 1, stderr);
  const record = JSON.parse(stdout);
  return record.verdict === 'passes' ? 'passes' : record.explanation.mistakes.join(' ');
}

for (const language of ['glsl', 'wgsl']) {
  test(`the page names what check-shader names: ${language}`, async (t) => {
    const page = await explorer(`lang=${language}&px=256`);
    if (!await openPanel(page)) return t.skip('built without WebAssembly');
    for (const [turn, [model, value]] of kShaders.entries()) {
      const expected = programSays(model, shaderOf(value));
      if (expected.missing) return t.skip(expected.missing);
      // `turn` is no key of the page's, but makes each hash another one.
      await page.evaluate((hash) => new Promise((done) => {
        addEventListener('hashchange', done, { once: true });
        location.hash = hash;
      }).then(() => 0), `lang=${language}&px=256&model=${model}&turn=${turn}`);
      assert.equal(await resultOf(page, shaderOf(value, language)), expected, `${model}: ${value}`);
    }
    await close(page);
  });
}

test('the sphere shows the shader beside the model', async (t) => {
  const page = await explorer('px=256');
  if (!await openPanel(page)) return t.skip('built without WebAssembly');
  assert.equal(await resultOf(page, shaderOf(`2.0 * (n + 2.0) / (2.0 * ${kPi}) * pow(${mirror}, n) * ${cosine}`)), 'two-missing');
  await page.waitForFunction(() => /A − yours: .*50(\.0)? % of the brighter/.test(document.querySelector('#sphere-numbers').textContent));
  await requireAccessible(page, 'a shader beside the model');
  await page.getByRole('button', { name: 'Show B again' }).click();
  await page.waitForFunction(() => /A − B:/.test(document.querySelector('#sphere-numbers').textContent));
  await close(page);
});

test('a shader that does not compile is told with its line', async (t) => {
  const page = await explorer();
  if (!await openPanel(page)) return t.skip('built without WebAssembly');
  assert.match(await resultOf(page, 'float h(vec3 N, vec3 V, vec3 L, float n)\n{\n    return missing;\n}\n'), /^line 3: .*missing/);
  assert.match(await resultOf(page, '#include "x"\n'), /include is not allowed/);
  assert.match(await resultOf(page, 'nothing'), /no function/);
  await page.fill('#own-arguments', 'N,X');
  assert.match(await resultOf(page, 'float h(vec3 N) { return 1.0; }'), /'X' is unknown/);
  await close(page);
});

test('a link carries the shader as text, which runs when the reader says so', async (t) => {
  const page = await explorer();
  if (!await openPanel(page)) return t.skip('built without WebAssembly');
  const hostile = `// </textarea><img src=x onerror=alert(1)>\n${shaderOf(`(n + 2.0) / 2.0 * pow(${mirror}, n) * ${cosine}`)}`;
  await page.fill('#own-text', hostile);
  await page.getByRole('button', { name: 'Copy link' }).click();
  await page.waitForFunction(() => location.hash.includes('own='));
  const other = await explorer(new URL(await page.evaluate(() => location.href)).hash.slice(1));
  await says(other, '.own-status', /came with the link/);
  assert.equal(await other.inputValue('#own-text'), hostile);
  assert.equal(await other.locator('.own-verdict').count(), 0);
  assert.equal(await resultOf(other), 'pi-missing');
  await close(other);
  await close(page);
  for (const own of ['AAAA', '%3Cb%3E', 'x'.repeat(50_000), Buffer.alloc(3).toString('base64url')]) {
    const broken = await explorer(`own=${own}`);
    await says(broken, '.own-status', /no shader that can be read/);
    await close(broken);
  }
});

test('a shader that does not end leaves the page alive', async (t) => {
  const { browser: own, kill } = await launchToKill();
  t.after(kill);
  const page = await open(own, `${fileUrl(site)}explorer.html`);
  if (!await openPanel(page)) return t.skip('built without WebAssembly');
  await page.fill('#own-text', 'float h(vec3 N, vec3 V, vec3 L, float n)\n{\n    float s = n;\n    for (int i = 0; i >= 0; i = i) { s = fract(sin(s) * 43758.5) + 1.0; if (s < 0.5) break; }\n    return s;\n}\n');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  // The browser may have ended it before: then it says that.
  await page.waitForFunction(() => /did not end|took WebGL/.test(document.querySelector('.own-status').textContent));
  await page.fill('#own-text', 'the page answers');
  assert.equal(await page.inputValue('#own-text'), 'the page answers');
});
