// What a publication changes, of the site and of the run, and what is said of it on every page.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { spawnSync } from 'node:child_process';
import path from 'node:path';
import { test } from 'node:test';
import { lobelia, program, scratch } from './browser.mjs';
import { writeFarm } from './farm.mjs';

function published(options = []) {
  const directory = scratch(), run = path.join(directory, 'run'), site = path.join(directory, 'site');
  writeFarm(run, { axes: { model: ['phong', 'blinn'] }, size: 8 });
  lobelia('gallery', run, '-o', site, ...options);
  return { run, site };
}

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
