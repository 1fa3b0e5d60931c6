// The studies of a run, in small: explorer, stability, paper, cost and search.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { lobelia } from './browser.mjs';
import { made, png } from './farm.mjs';

function put(run, file, record) {
  mkdirSync(path.dirname(path.join(run, file)), { recursive: true });
  writeFileSync(path.join(run, file), JSON.stringify(record));
}

const errors = (ofPeak) => ({ ofPeak, ulp: ofPeak === 'inf' ? 'inf' : ofPeak * 1e7, wrongPixels: 0 });
const summary = (rest, naive) => ({ group: 'lobe', ...rest, cases: 3, outside: 0, notCompared: 0, naive: errors(naive), ours: errors(1e-8), ofBound: 0.5 });
const curve = (exponent) => ({ exponent, model: 'modified_phong', lobe: 'cosine', degrees: [0, 1, 2], truth: [1, 0.5, 0.1], naive: [1.2, 0.4, 'inf'], ours: [1, 0.5, 0.1] });
const claim = (name, verdict) => ({ name, where: 'eq. (1)', statement: `it is so: ${name}`, printed: '1.7e-2', verdict,
  measured: [{ what: 'largest', value: 0.017, text: '1.70e-2', at: 'n = 16' }], definition: 'by a scan up to theta_cr, near 6/sqrt(n)', reason: 'as (1 - s)^n has it; see first' });
const variant = (name, median, max) => ({ name, settings: {}, seconds: { median, spread: 0.05, least: median, most: median, rounds: 5 }, errors: { max } });

const pictureOf = (name) => ({ exr: `${name}.exr`, png: `${name}.png`, error: `${name}-error.png`, largestErrorOfPeak: 0.01 });

/** Returns the explorer's tables. `hostile` is a name in every record. */
export function writeStudies(run, hostile) {
  mkdirSync(path.join(run, 'explorer'));
  lobelia('models', '--tables', path.join(run, 'explorer/tables.json'));
  const tables = JSON.parse(readFileSync(path.join(run, 'explorer/tables.json'), 'utf8'));
  put(run, 'stability/stability.json', made('verify-stability', {
    command: ['lobelia', 'verify', 'stability'], instructionSet: 'AVX2', cases: 9, outside: 0, notCompared: 0, byLobe: [], groups: [{ name: 'lobe', meaning: hostile }],
    byCase: [summary({ case: hostile }, 'inf')],
    byExponent: ['cosine', 'cs16'].flatMap((lobe) => [1, 100, 1e4].map((n) => summary({ lobe, exponent: n }, lobe === 'cs16' && n > 100 ? 'inf' : n * 1e-6))),
    curves: [curve(1e3), curve(1e6)],
    pictures: [{ exponent: 1000, naive: pictureOf('naive'), ours: pictureOf('ours') }],
  }));
  for (const [name, colour] of [['naive', 40], ['naive-error', 80], ['ours', 120], ['ours-error', 160]])
    writeFileSync(path.join(run, `stability/${name}.png`), png(16, 16, () => [colour, colour, colour]));
  put(run, 'paper/paper.json', made('verify-paper', {
    command: ['lobelia', 'verify', 'paper'], confirmed: 1, notReproduced: 1, found: 1, claims: [claim('first', 'confirmed'), claim('second', 'not reproduced'), claim(hostile, 'found')],
    figures: [{ id: 'a"b', title: 'A figure', description: 'shown', x: { label: 'n', from: 16, to: 1024, logarithmic: true, ticks: [16, 1024] },
      y: { label: 'energy', from: 0, to: 1 }, bands: [], series: [{ name: 'line', style: 1, x: [16, 128, 1024], y: [0, 0.25, 0.5] }], claims: ['second'] }],
  }));
  put(run, 'cost/cost.json', made('cost', { command: ['lobelia', 'cost', '/srv/someone/scene.xml'], host: { processor: 'abacus', threads: 2, system: 'Debian' }, instructionSet: 'AVX2', tables: [{
    id: 'lobe', unit: 's', level: 'lobe', title: 'A lobe', per: 'evaluation', errors: [{ id: 'max', meaning: 'largest error' }],
    ways: [variant('quick', 1e-9, 0.1), variant('middling', 2e-9, 0.05), variant('slow', 8e-9, 1e-7), variant(hostile, 9e-9, 0.2), variant('unknown', 1e-9, 'nan')],
    fronts: { max: { ways: ['quick', 'middling', 'slow'], dominatedBy: {}, inWords: ['quick to slow'], chart: 'lobe-max.svg' } }, remarks: [] }] }));
  mkdirSync(path.join(run, 'search'));
  const searchFile = path.join(run, 'search/search.json');
  lobelia('search', '-q', '--operations', '5', '--family', 'pk', '--json', searchFile);
  const found = JSON.parse(readFileSync(searchFile, 'utf8'));
  found.lobes[0].formula = hostile;
  put(run, 'search/search.json', found);
  return tables;
}
