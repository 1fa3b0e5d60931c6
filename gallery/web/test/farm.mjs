// A farm's directory without a farm: records as docs/records.md lays them out, and pictures of a made-up highlight.
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import * as zlib from 'node:zlib';

export const made = (kind, rest) => ({ schemaVersion: 1, kind, madeBy: 'lobelia test', ...rest });
const json = (file, record) => writeFileSync(file, JSON.stringify(record));

/** As the farm writes it, to the byte: by its seal a gallery knows that nobody has changed it. */
export const text = (record, indent) => JSON.stringify(record, null, indent).replace(/(?<=[:,[]\s*)-?[\d.]+(e[-+]?\d+)?(?=\s*[,\]}])/g,
  (number) => Math.abs(Number(number)) < 1e-4 ? Number(number).toExponential().replace(/^0e\+0$/, '0').replace(/e-(\d)$/, 'e-0$1') : number);
export const hash = (bytes) => createHash('sha256').update(bytes).digest('hex');

/** Puts the hashes of a cell's files into its record. */
export function seal(cell) {
  const file = path.join(cell, 'cell.json'), record = JSON.parse(readFileSync(file, 'utf8'));
  delete record.seal;
  record.files = readdirSync(cell).filter((name) => /^(scene\.xml|(?!cell\.)[^.]+\.(exr|png|json))$/.test(name)).sort()
    .map((name) => ({ name, sha256: hash(readFileSync(path.join(cell, name))) }));
  record.seal = hash(text(record));
  writeFileSync(file, text(record, 2) + '\n');
}

function crc32(bytes) {
  if (zlib.crc32) return zlib.crc32(bytes);  // not in node 18
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = crc >>> 1 ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

export function png(width, height, rgbOf) {
  const raw = Buffer.alloc(height * (1 + 3 * width));
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) raw.set(rgbOf(x, y), y * (1 + 3 * width) + 1 + 3 * x);
  return pngOf(width, height, raw);
}

/** `raw`: before each row of pixels its filter. */
export function pngOf(width, height, raw, options = {}) {
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type), data]), ends = Buffer.alloc(8);
    ends.writeUInt32BE(data.length, 0);
    ends.writeUInt32BE(crc32(body), 4);
    return Buffer.concat([ends.subarray(0, 4), body, ends.subarray(4)]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', head), chunk('IDAT', zlib.deflateSync(raw, options)),
    chunk('IEND', Buffer.alloc(0))]);
}

/** Float32, not compressed. */
export function exr(width, height, rgbOf) {
  const parts = [Buffer.from([0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0])];
  const i32 = (...values) => { const b = Buffer.alloc(4 * values.length); values.forEach((v, i) => b.writeInt32LE(v, 4 * i)); return b; };
  const f32 = (...values) => { const b = Buffer.alloc(4 * values.length); values.forEach((v, i) => b.writeFloatLE(v, 4 * i)); return b; };
  const attribute = (name, type, value) =>
    parts.push(Buffer.from(`${name}\0${type}\0`), i32(value.length), value);
  const channel = (name) => Buffer.concat([Buffer.from(name + '\0'), i32(2), Buffer.alloc(4), i32(1, 1)]);
  attribute('channels', 'chlist', Buffer.concat([channel('B'), channel('G'), channel('R'), Buffer.alloc(1)]));
  attribute('compression', 'compression', Buffer.from([0]));
  attribute('dataWindow', 'box2i', i32(0, 0, width - 1, height - 1));
  attribute('displayWindow', 'box2i', i32(0, 0, width - 1, height - 1));
  attribute('lineOrder', 'lineOrder', Buffer.from([0]));
  attribute('pixelAspectRatio', 'float', f32(1));
  attribute('screenWindowCenter', 'v2f', f32(0, 0));
  attribute('screenWindowWidth', 'float', f32(1));
  parts.push(Buffer.alloc(1));
  const header = Buffer.concat(parts), row = 12 * width, offsets = Buffer.alloc(8 * height);
  const rows = [];
  for (let y = 0; y < height; ++y) {
    offsets.writeBigUInt64LE(BigInt(header.length + offsets.length + y * (8 + row)), 8 * y);
    const values = Buffer.alloc(row);
    for (let x = 0; x < width; ++x) {
      const rgb = rgbOf(x, y);
      for (let c = 0; c < 3; ++c) values.writeFloatLE(rgb[2 - c], 4 * (c * width + x));
    }
    rows.push(i32(y, row), values);
  }
  return Buffer.concat([header, offsets, ...rows]);
}

export const encode = (v) => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * Math.min(v, 1) ** (1 / 2.4) - 0.055));

/** Ours at (x, y); each engine adds an error of its own. */
export const kPeak = 2.5;
export const ours = (x, y, size) => {
  const r2 = ((x - size / 2) ** 2 + (y - size / 3) ** 2) / size ** 2;
  const v = kPeak * Math.exp(-40 * r2);
  return [Math.fround(v), Math.fround(v / 2), Math.fround(v / 4)];
};
export const errorOf = { analytic: 0, povray: 2e-6, blender: 1e-3 };

/** Something between -1 and 1 that looks like chance. */
const dither = (x, y, c, seed) => { const v = Math.sin(x * 12.9898 + y * 78.233 + c * 37.7 + seed * 91.3) * 43758.5453; return 2 * (v - Math.floor(v)) - 1; };

export const kEngines = [['lobelia', 'Lobelia'], ['analytic', 'Analytic'], ['povray', 'POV-Ray'], ['blender', 'Blender Cycles']];

/** All cells of a farm have the same pictures. */
const shown = new Map();
function shownOnce(key, make) {
  if (!shown.has(key)) shown.set(key, make());
  return shown.get(key);
}

function writeCell(cell, id, axes, status, size, pictures, noise) {
  mkdirSync(cell, { recursive: true });
  const isFull = pictures === true, hasFigures = isFull || pictures === 'figures';
  if (isFull) writeFileSync(path.join(cell, 'scene.xml'), '<scene/>');
  const images = [];
  for (const [engine] of isFull ? kEngines : pictures ? kEngines.slice(0, 1) : []) {
    const value = (x, y) => ours(x, y, size).map((v, c) => (v + 0.2) * (1 + noise * dither(x, y, c, engine.length)) - 0.2 + v * (errorOf[engine] ?? 0));
    writeFileSync(path.join(cell, `${engine}.png`), shownOnce(`${engine} ${size} ${noise}`, () => png(size, size, (x, y) => value(x, y).map((v) => encode(v / kPeak)))));
    images.push({ engine, ...(isFull ? { exr: `${engine}.exr` } : {}), png: `${engine}.png`, record: `${engine}.json`, sha256: '' });
    if (isFull) writeFileSync(path.join(cell, `${engine}.exr`), exr(size, size, value));
    const both = { engine: { name: engine, version: '1.2.3' }, command: ['lobelia', 'render', 'scene.xml'], image: { file: `${engine}.exr`, width: size, height: size } };
    json(path.join(cell, `${engine}.json`), engine === 'lobelia'
      ? made('render', { ...both, highlights: [], samples: 1, seed: 0, rays: { camera: 4, shadow: 0, mirror: 0, scattered: 0 },
        plan: { effects: [{ name: 'shadows', on: false, reason: 'one convex body' }], precision: 'float64', kernel: 'plain' },
        instructionSet: 'AVX2', seconds: { plan: 0.05, render: 0.2, total: 0.25 } })
      : made('reference', { ...both, witness: 'native', method: 'one pass', passes: 1, engineCommands: [], seconds: { total: 0.25 } }));
  }
  const comparisons = [];
  for (const [engine] of hasFigures ? kEngines.slice(1) : []) {
    const worst = errorOf[engine], differs = status === 'differs' && engine === 'blender', limit = differs ? worst / 2 : 1e-2;
    json(path.join(cell, `lobelia-${engine}.json`), made('comparison', {
      verdict: differs ? 'differs' : 'pass', a: 'lobelia.exr', b: `${engine}.exr`, nonfinite: { a: 0, b: 0 },
      viewing: { exposureStops: -1.3, pixelsPerDegree: 67 },
      metrics: { rmse: worst * 0.1, max_abs: worst * kPeak, 'max_abs.x': size / 2, 'max_abs.y': Math.round(size / 3), max_rel_peak: worst, ssim: 1 - worst, drift: engine === 'povray' ? -2e-7 : 1e-7 },
      limits: [{ metric: 'max_rel_peak', limit, value: worst, pass: !differs }], disagreement: [],
    }));
    writeFileSync(path.join(cell, `lobelia-${engine}.png`), shownOnce(`difference ${size}`, () => png(size, size, (x, y) => ours(x, y, size).map((v) => encode(v / kPeak)))));
    comparisons.push({ a: 'lobelia', b: engine, record: `lobelia-${engine}.json`, png: `lobelia-${engine}.png`,
      difference: { whiteAt: (worst || 1e-6) * kPeak, relativeToPeak: worst || 1e-6 } });
  }
  const degrees = Array.from({ length: 60 }, (_, i) => i + 0.5), curve = degrees.map((d) => kPeak * Math.exp(-d * d / 200));
  if (isFull) json(path.join(cell, 'profile.json'), made('profile', {
    light: 0, sphere: 0, angle: 'reflection',
    zones: { epicentreDegrees: [0, 10], flankDegrees: [10, 20], bloomingDegrees: [20, 40] },
    curve: { angleDegrees: degrees, pixels: degrees.map(() => 3), analytic: curve,
      ...Object.fromEntries(['lobelia', 'povray', 'blender'].map((e) => [e, curve.map((v, i) => v * (1 + (errorOf[e] ?? 0) * Math.cos(i)))])) },
    images: { lobelia: { peak: 2.5, peakAngleDegrees: 0, halfWidthDegrees: 11.8, energy: 0.01 } },
    differences: { 'lobelia-povray': Object.fromEntries(['epicentre', 'flank', 'blooming'].map((zone) => [zone, { pixels: 3, maxAbs: 1e-3, rms: 1e-3, maxRelPeak: 1e-3 }])) },
  }));
  json(path.join(cell, 'cell.json'), made('cell', { id, axes, status, exposureStops: Math.log2(1 / kPeak),
    highlight: { model: 'phong_rdf', lobe: 'cosine', normalisation: 'exact', exponent: 16, coefficient: 2.7 }, images, comparisons,
    ...(isFull ? { profile: 'profile.json' } : {}), notComparable: [],
    problems: status === 'failed' ? [{ engine: 'blender', message: 'stopped after 600 s', failure: 'timed out', attempts: 3 }] : [],
    madeFrom: { program: '', libraries: '', arithmetic: { libm: '', kernels: '', processor: '' }, scene: '', contents: {}, engines: {} },
    results: {}, files: [] }));
  seal(cell);
}

/**
 * Writes a farm. `axes`: { model: ['a', 'b'] }; `cell`: what to change of a cell of the product, by its number;
 * its `pictures` are true, false, or 'thumbnail' for ours alone, as an 8-bit file, 'figures' for that and comparisons. `noise` is relative, in every value by itself.
 */
export function writeFarm(directory, { title = 'A small farm', axes, size = 64, noise = 0, cell = () => ({}) }) {
  const names = Object.keys(axes);
  let places = [{}];
  for (const name of names) places = places.flatMap((place) => axes[name].map((value) => ({ ...place, [name]: value })));
  const cells = places.map((place, i) => ({ id: Object.values(place).join('-'), status: 'pass', axes: place, pictures: true, ...cell(i, place) }));
  mkdirSync(path.join(directory, 'cells'), { recursive: true });
  json(path.join(directory, 'farm.json'), made('farm', {
    title, grid: 'small.xml', command: 'lobelia farm small.xml -o out', host: { processor: 'abacus', threads: 2, system: 'Debian' },
    axes: names.map((name) => ({ name, values: axes[name].map((value) => ({ value, label: value })) })),
    engines: kEngines.map(([name, engineTitle]) => ({ name, title: engineTitle, version: '1.2.3', available: true })),
    cells: cells.map(({ id, status, axes: at }) => ({ id, status, axes: at })),
  }));
  for (const { id, axes: at, status, pictures } of cells)
    if (status !== 'missing') writeCell(path.join(directory, 'cells', id), id, at, status, size, pictures, noise);
  return cells;
}
