// What is committed in dist/ is what src/ gives, has the right types, and is small.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const web = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const dist = (file) => readFileSync(path.join(web, 'dist', file));

test('the committed bundle is what the sources give, byte for byte', () => {
  const out = mkdtempSync(path.join(tmpdir(), 'lobelia-bundle-'));
  try {
    execFileSync(process.execPath, ['build.mjs', out], { cwd: web });
    assert.deepEqual(readdirSync(out).sort(), readdirSync(path.join(web, 'dist')).sort());
    for (const file of readdirSync(out))
      assert.ok(readFileSync(path.join(out, file)).equals(dist(file)), `${file}: npm run build, and commit it`);
  } finally {
    rmSync(out, { recursive: true });
  }
});

test('the sources have the types that they say', () => {
  const tsc = path.join(web, 'node_modules/typescript/bin/tsc');
  execFileSync(process.execPath, [tsc, '--noEmit'], { cwd: web, stdio: ['ignore', 'inherit', 'inherit'] });
});

// As a server that compresses sends it; uPlot alone would be 22 KB; the explorer's sphere is 5, a reader's own shader 4, figures are 6, histograms of maps 1, and packed pixels 1.
const kBudget = { 'gallery.js': 53 * 1024, 'gallery.css': 8 * 1024 };

for (const [file, budget] of Object.entries(kBudget)) {
  test(`${file} stays within ${budget / 1024} KB compressed`, () => {
    const size = gzipSync(dist(file), { level: 9 }).length;
    assert.ok(size <= budget, `${size} bytes`);
  });
}

test('the script is a classic one that runs no text as code and knows no network', () => {
  const text = dist('gallery.js').toString();
  assert.doesNotMatch(text, /\bimport\s*[({"']|\bexport\s*\{|\beval\(|new Function|innerHTML|insertAdjacentHTML|document\.write/);
  for (const address of text.match(/https?:\/\/[^"'`\s]+/g) ?? [])
    assert.equal(address, 'http://www.w3.org/2000/svg');  // a namespace
});
