// A farm of very many cells, in the time that a person waits for: pictures and records differ from cell to cell as those of a
// real run do, in highlights, noise, figures and curves. There are 300 sets of pictures, which cells share as links.
import { linkSync, mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { hash, kEngines, made, pngOf, text } from './test/farm.mjs';

const kSets = 300, kSide = 128, kBins = 64;
const names = kEngines.map(([name]) => name), others = names.slice(1);
const error = { analytic: 1e-6, povray: 4e-4, blender: 3e-5 };

/** From 0 to 1, the same for the same numbers. */
const chance = (...numbers) => { let v = 7; for (const n of numbers) { v = Math.imul(v ^ n, 0x9e3779b1); v ^= v >>> 15; } return (v >>> 0) / 2 ** 32; };
const encoded = Array.from({ length: 4097 }, (_, i) => { const v = i / 4096; return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055)); });
const shade = (v) => encoded[Math.min(4096, Math.max(0, Math.round(4096 * v)))];

/** A PNG of what `of` gives at each pixel, times `tint`. */
function picture(of, tint) {
  const raw = new Uint8Array(kSide * (1 + 3 * kSide));
  for (let y = 0, at = 0; y < kSide; ++y) {
    ++at;
    for (let x = 0; x < kSide; ++x) {
      const v = of(y * kSide + x);
      raw[at++] = shade(v * tint[0]);
      raw[at++] = shade(v * tint[1]);
      raw[at++] = shade(v * tint[2]);
    }
  }
  return pngOf(kSide, kSide, raw, { level: 3 });
}

/** A highlight on a sphere before black, grey or coloured; and what is left of it in a difference, which is mostly chance. */
function pictures(set) {
  const x0 = kSide * (0.3 + 0.4 * chance(set, 1)), y0 = kSide * (0.3 + 0.4 * chance(set, 2)), width = 0.02 + 0.14 * chance(set, 3) ** 2;
  const grey = [1, 1, 1], tint = set % 3 === 0 ? [1, 0.5 + 0.5 * chance(set, 4), chance(set, 5)] : grey;
  const light = Float64Array.from({ length: kSide ** 2 }, (_, i) => {
    const x = i % kSide, y = Math.floor(i / kSide);
    return (x - 63.5) ** 2 + (y - 63.5) ** 2 > 62 ** 2 ? 0 : Math.exp(-((x - x0) ** 2 + (y - y0) ** 2) / (width * kSide) ** 2);
  });
  const files = {};
  for (const [k, engine] of names.entries())
    files[`${engine}.png`] = picture(engine === 'blender' ? (i) => light[i] * (1 + 0.01 * chance(i, k, set)) : (i) => light[i], tint);
  for (const [k, engine] of others.entries())
    files[`lobelia-${engine}.png`] = picture((i) => light[i] * chance(i, k, set) * (engine === 'analytic' ? 0.02 : 0.6), grey);
  return files;
}

function comparison(engine, i, k) {
  const value = (n, size) => size * (0.5 + chance(i, k, n)), worst = value(0, error[engine]), isOver = i % 500 === 7 && engine === 'blender';
  return made('comparison', {
    verdict: isOver ? 'differs' : 'pass', a: 'lobelia.exr', b: `${engine}.exr`, nonfinite: { a: 0, b: 0 }, viewing: { exposureStops: -1.3, pixelsPerDegree: 67 },
    metrics: { mae: value(1, worst / 50), mse: value(2, worst ** 2), rmse: value(3, worst / 9), psnr: 90 + value(4, 20), drift: value(5, worst) - worst, max_abs: worst * 2.5,
      'max_abs.x': Math.floor(value(6, 60)), 'max_abs.y': Math.floor(value(7, 60)), peak: value(12, 5), max_rel_peak: worst, 'ciede2000.mean': value(8, worst / 5), 'ciede2000.p95': value(13, worst / 4), 'ciede2000.max': value(9, worst * 28),
      'delta_e_itp.max': value(10, worst * 70), 'delta_e_itp.mean': value(14, worst * 2), ssim: 1 - value(11, worst / 1e3), 'flip.ldr.mean': value(15, worst / 20), outliers: 0 },
    limits: [{ metric: 'max_rel_peak', limit: isOver ? worst / 2 : 1e-2, value: worst, pass: !isOver }], disagreement: [],
  });
}

/** The seal is of the text, and JavaScript does not write every number as the farm does. It does these. */
const kFactors = [1, 1.5, 2];
const seconds = (i, k) => 0.01 + 5 * chance(i, k, 20) ** 4;
const madeWith = (engine) => ({ engine: { name: engine, version: '1.2.3' }, image: { file: `${engine}.exr`, width: kSide, height: kSide }, command: ['lobelia', 'render', 'scene.xml', '-o', `${engine}.exr`] });

/** By file. */
function records(i) {
  const n = 4 + 40 * chance(i, 30), degrees = Array.from({ length: kBins }, (_, k) => (k + 0.3 + 0.4 * chance(i, k, 31)) * 0.36);
  const formula = degrees.map((d) => 2.5 * Math.cos(d * Math.PI / 180) ** n), zones = [0, 1, 2, 3].map((z) => z * 40 / Math.sqrt(n));
  const all = {
    'lobelia.json': made('render', { ...madeWith('lobelia'), highlights: [], samples: 1, seed: 0, rays: { camera: 4 * Math.floor(1e4 * chance(i, 32)), shadow: 0, mirror: 0, scattered: 0 },
      plan: { effects: [{ name: 'shadows', on: false, reason: 'one convex body' }], precision: 'float64', kernel: 'plain' }, instructionSet: 'AVX2',
      seconds: { plan: seconds(i, 0) / 9, render: seconds(i, 0), total: seconds(i, 0) * 1.2 } }),
    'profile.json': made('profile', { light: 0, sphere: 0, angle: 'reflection', zones: { epicentreDegrees: [0, zones[1]], flankDegrees: [zones[1], zones[2]], bloomingDegrees: [zones[2], zones[3]] },
      curve: { angleDegrees: degrees, pixels: degrees.map((_, k) => 2 * k + 1), analytic: formula,
        ...Object.fromEntries(names.filter((e) => e !== 'analytic').map((e, k) => [e, formula.map((v, d) => v * (1 + (error[e] ?? 1e-7) * (chance(i, k, d, 33) - 0.5)))])) },
      images: { lobelia: { peak: 2.5, peakAngleDegrees: 0, halfWidthDegrees: zones[1] * 1.2, energy: 1 / n } }, differences: {} }),
  };
  for (const [k, engine] of others.entries()) {
    all[`${engine}.json`] = made('reference', { ...madeWith(engine), witness: 'native', method: 'one pass', passes: 1, engineCommands: [`/usr/bin/${engine} pass0`], seconds: { total: seconds(i, k + 1) } });
    all[`lobelia-${engine}.json`] = comparison(engine, i, k);
  }
  return all;
}

/** `axes`: values by name. */
export function writeLargeFarm(directory, axes) {
  const sets = [], stock = path.join(directory, 'stock'), axisNames = Object.keys(axes);
  mkdirSync(stock, { recursive: true });
  let places = [{}];
  for (const name of axisNames) places = places.flatMap((place) => axes[name].map((value) => ({ ...place, [name]: value })));
  const count = places.length, statusOf = (i) => (i % 500 === 7 ? 'differs' : 'pass');
  for (let set = 0; set < Math.min(kSets, count); ++set)
    sets.push(Object.entries(pictures(set)).map(([name, bytes]) => {
      const file = path.join(stock, `${set}-${name}`);
      writeFileSync(file, bytes);
      return { name, file, sha256: hash(bytes) };
    }));
  const cells = places.map((at, i) => ({ id: Object.values(at).join('-'), status: statusOf(i), axes: at }));
  for (const [i, { id, axes: at, status }] of cells.entries()) {
    const folder = path.join(directory, 'cells', id), set = sets[(i * 193) % sets.length];
    mkdirSync(folder, { recursive: true });
    for (const { name, file } of set) linkSync(file, path.join(folder, name));
    const files = set.map(({ name, sha256 }) => ({ name, sha256 }));
    for (const [name, record] of Object.entries(records(i))) {
      const json = JSON.stringify(record);
      writeFileSync(path.join(folder, name), json);
      files.push({ name, sha256: hash(json) });
    }
    files.sort((p, q) => (p.name < q.name ? -1 : 1));
    const record = made('cell', { id, axes: at, status, exposureStops: -1.3,
      highlight: { model: 'phong_rdf', lobe: 'cosine', normalisation: 'exact', exponent: 16, coefficient: 2.7 },
      images: names.map((engine) => ({ engine, png: `${engine}.png`, record: `${engine}.json`, sha256: '' })),
      comparisons: others.map((engine) => ({ a: 'lobelia', b: engine, record: `lobelia-${engine}.json`, png: `lobelia-${engine}.png`,
        difference: { whiteAt: error[engine] * kFactors[i % 3], relativeToPeak: error[engine] * kFactors[(i >> 2) % 3] } })),
      profile: 'profile.json', notComparable: [], problems: [], madeFrom: { program: '', libraries: '', arithmetic: { libm: '', kernels: '', processor: '' }, scene: '', contents: {}, engines: {} },
      results: {}, files });
    record.seal = hash(text(record));
    writeFileSync(path.join(folder, 'cell.json'), text(record, 2) + '\n');
  }
  // Last, so that a farm that was begun and not ended is not taken for one.
  writeFileSync(path.join(directory, 'farm.json'), JSON.stringify(made('farm', {
    title: 'A large farm', grid: 'large.xml', command: 'lobelia farm large.xml -o out', host: { processor: 'abacus', threads: 2, system: 'Debian' },
    axes: axisNames.map((name) => ({ name, values: axes[name].map((value) => ({ value, label: value })) })),
    engines: kEngines.map(([name, title]) => ({ name, title, version: '1.2.3', available: true })), cells,
  })));
}
