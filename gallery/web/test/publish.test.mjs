// What a second publication changes, and what the preview server gives away.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import { spawnSync } from 'node:child_process';
import path from 'node:path';
import { test } from 'node:test';
import { lobelia, program, scratch, serve } from './browser.mjs';
import { png, seal, writeFarm } from './farm.mjs';

const kAxes = { model: ['phong', 'blinn'] };
const times = (site) => Object.fromEntries(readdirSync(site, { recursive: true }).map(String)
  .filter((f) => statSync(path.join(site, f)).isFile()).sort().map((f) => [f, statSync(path.join(site, f)).mtimeMs]));

function published(options = []) {
  const directory = scratch(), run = path.join(directory, 'run'), site = path.join(directory, 'site');
  writeFarm(run, { axes: kAxes, size: 8 });
  lobelia('gallery', run, '-o', site, ...options);
  return { directory, run, site };
}

test('publishing again touches no file', () => {
  const { run, site } = published();
  const before = times(site);
  assert.ok(Object.keys(before).length > 30);
  lobelia('gallery', run, '-o', site);
  assert.deepEqual(times(site), before);
});

test('a changed picture changes its own files, and the pages that show its hash', () => {
  const { run, site } = published();
  const before = times(site);
  writeFileSync(path.join(run, 'cells/phong/povray.png'), png(8, 8, () => [1, 2, 3]));
  seal(path.join(run, 'cells/phong'));
  lobelia('gallery', run, '-o', site);
  const now = times(site);
  const changed = Object.keys(now).filter((f) => now[f] !== before[f]);
  assert.deepEqual(changed, ['cells/phong/cell.json', 'cells/phong/povray.png']);
});

test('what belongs to a cell that is gone is removed, and nothing else', () => {
  const { directory, run, site } = published();
  writeFileSync(path.join(site, 'cells/blinn/mine.txt'), 'a note of my own');
  mkdirSync(path.join(directory, 'outside'));
  writeFileSync(path.join(directory, 'outside/index.html'), 'elsewhere');
  rmSync(run, { recursive: true });
  writeFarm(run, { axes: { model: ['phong'] }, size: 8 });
  // A list that somebody has changed must not lead out of the site.
  const list = JSON.parse(readFileSync(path.join(site, 'gallery.json'), 'utf8'));
  symlinkSync(path.join(directory, 'outside'), path.join(site, 'link'));
  list.files.push('../outside/index.html', 'link/index.html', '/etc/hostname');
  writeFileSync(path.join(site, 'gallery.json'), JSON.stringify(list));
  lobelia('gallery', run, '-o', site);
  assert.deepEqual(readdirSync(path.join(site, 'cells/blinn')), ['mine.txt']);
  assert.ok(existsSync(path.join(site, 'cells/phong/index.html')));
  assert.ok(existsSync(path.join(directory, 'outside/index.html')));
});

test('in the run itself nothing of the run is ever removed', () => {
  const { run } = published();
  lobelia('gallery', run);
  lobelia('gallery', run, '--metrics-only');
  for (const file of ['farm.json', 'cells/phong/lobelia.exr', 'cells/phong/povray.json'])
    assert.ok(existsSync(path.join(run, file)), file);
  assert.ok(!existsSync(path.join(run, 'cells/phong/lobelia.float.js')));
});

test('a title and an address are in every page, and an odd address is refused', () => {
  const { site } = published(['--title', 'Mine & <yours>', '--base-url', 'https://example.org/a']);
  const page = readFileSync(path.join(site, 'cells/phong/index.html'), 'utf8');
  assert.match(page, /<link rel="canonical" href="https:\/\/example\.org\/a\/cells\/phong\/index\.html" ?\/>/);
  assert.match(page, /og:image/);
  assert.match(readFileSync(path.join(site, 'index.html'), 'utf8'), /<h1>Mine &amp; &lt;yours&gt;<\/h1>/);
  for (const url of ['javascript:alert(1)', 'https://example.org/?q', 'ftp://example.org', 'https://a b.org', 'https://'])
    assert.equal(spawnSync(program, ['gallery', path.join(site, '../run'), '-o', site, '--base-url', url]).status, 2, url);
});

const ask = (url, target, { method = 'GET', headers = {} } = {}) => new Promise((resolve, reject) => {
  const { hostname, port } = new URL(url);
  request({ hostname, port, path: target, method, headers }, (answer) => {
    let body = '';
    answer.on('data', (text) => { body += text; }).on('end', () => resolve({ status: answer.statusCode, headers: answer.headers, body }));
  }).on('error', reject).end();
});

test('the preview gives files of the site with their types and policy, to this machine, and nothing else', async () => {
  const { directory, site } = published();
  writeFileSync(path.join(directory, 'secret.txt'), 'secret');
  writeFileSync(path.join(site, '.hidden'), 'secret');
  symlinkSync(path.join(directory, 'secret.txt'), path.join(site, 'leak.txt'));
  symlinkSync(directory, path.join(site, 'up'));
  const { url, stop } = await serve(site);
  assert.match(url, /^http:\/\/127\.0\.0\.1:\d+\/$/);
  for (const [target, type] of [['/', 'text/html'], ['/index.html', 'text/html'], ['/gallery.js', 'text/javascript'], ['/gallery.css', 'text/css'],
    ['/gallery.json', 'application/json'], ['/cells/phong/lobelia.png', 'image/png'], ['/cells/phong/lobelia.exr', 'image/x-exr'], ['/cells/phong/', 'text/html']]) {
    const { status, headers, body } = await ask(url, target);
    assert.equal(status, 200, target);
    assert.ok(headers['content-type'].startsWith(type), `${target}: ${headers['content-type']}`);
    assert.match(headers['content-security-policy'], /default-src 'none'/);
    assert.equal(headers['x-content-type-options'], 'nosniff');
    assert.ok(body.length > 0);
    const head = await ask(url, target, { method: 'HEAD' });
    assert.deepEqual([head.status, head.body, head.headers['content-length']], [200, '', headers['content-length']]);
  }
  assert.equal((await ask(url, '/cells/phong')).headers.location, '/cells/phong/');
  for (const target of ['/../secret.txt', '/%2e%2e/secret.txt', '/..%2fsecret.txt', '/cells/../../secret.txt', '/.hidden', '/leak.txt', '/up/secret.txt',
    '/%00', '/gallery.js%00.png', '//etc/passwd', '/cells\\..\\..\\secret.txt', '/no-such-file', '/cells/']) {
    const { status, body } = await ask(url, target);
    assert.ok(status === 404 || status === 400, `${target}: ${status}`);
    assert.doesNotMatch(body, /secret|root:/, target);
  }
  for (const method of ['POST', 'PUT', 'DELETE', 'OPTIONS', 'PATCH'])
    assert.equal((await ask(url, '/', { method })).status, 405, method);
  assert.equal((await ask(url, '/', { headers: { host: 'attacker.example' } })).status, 403);
  const taken = spawnSync(program, ['gallery', 'serve', site, '--port', new URL(url).port]);
  assert.equal(taken.status, 4, 'a port that is taken');
  await stop();
});
