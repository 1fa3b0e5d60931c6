// How a grid of many cells fares in the browser: `LOBELIA_PROGRAM=... node bench.mjs [CELLS]` prints the time until it can be
// used, the time of Find and of a cell's page, the browser's memory, and the files and bytes of the site. 150000 cells are the
// most that a farm has. GRID_BENCH=DIR keeps the farm there; GRID_OPTIONS are for `lobelia gallery`, such as --no-packed.
import { existsSync, readFileSync, readdirSync, readlinkSync, statSync } from 'node:fs';
import path from 'node:path';
import { fileUrl, launch, lobelia, open, scratch } from './test/browser.mjs';
import { writeLargeFarm } from './bench_farm.mjs';

const count = Number(process.argv[2] ?? 20_000), directory = process.env.GRID_BENCH ?? scratch();
const run = path.join(directory, `run-${count}`), site = path.join(directory, process.env.GRID_SITE ?? `site-${count}`);
const values = (name, n) => Array.from({ length: n }, (_, i) => `${name} ${i + 1}`);
const seconds = (from) => ((performance.now() - from) / 1000).toFixed(2) + ' s';

if (!existsSync(path.join(run, 'farm.json')))
  writeLargeFarm(run, { model: values('model', 10), exponent: values('n =', 20), roughness: values('rough', Math.ceil(count / 2000)), light: values('light', 10) });
const published = performance.now();
lobelia('gallery', run, '-o', site, '--metrics-only', ...(process.env.GRID_OPTIONS ?? '').split(' ').filter(Boolean));
console.log(`${count} cells published in ${seconds(published)}`);

const files = readdirSync(site, { recursive: true }).map((name) => statSync(path.join(site, String(name)))).filter((s) => s.isFile());
const megabytes = files.reduce((sum, s) => sum + s.size, 0) / 1e6;

const browser = await launch(), whole = await browser.newBrowserCDPSession();
const readable = (file, read = readFileSync) => { try { return read(file, 'utf8'); } catch { return ''; } };
/** From a process's id in our PID namespace to that in /proc, which may be of one further out. */
function idsInProc() {
  const ids = new Map(), ours = readlinkSync('/proc/self/ns/pid');
  for (const name of readdirSync('/proc').filter((entry) => /^\d+$/.test(entry)))
    if (readable(`/proc/${name}/ns/pid`, readlinkSync) === ours)
      ids.set(Number(/^NSpid:.*\s(\d+)$/m.exec(readable(`/proc/${name}/status`))?.[1]), name);
  return ids;
}
/** Megabytes of the largest page's process, and of all processes. */
async function memory() {
  const { processInfo } = await whole.send('SystemInfo.getProcessInfo'), ids = idsInProc();
  const resident = ({ id }) => Number(/^Pss:\s+(\d+)/m.exec(readable(`/proc/${ids.get(id)}/smaps_rollup`))?.[1] ?? 0) / 1000;
  return { page: Math.max(0, ...processInfo.filter((p) => p.type === 'renderer').map(resident)), all: processInfo.reduce((sum, p) => sum + resident(p), 0) };
}
const blank = await open(browser, 'about:blank');
await blank.waitForTimeout(500);
const empty = await memory();
await blank.context().close();

const from = performance.now(), page = await open(browser, fileUrl(site) + 'index.html');
await page.locator('.cell').first().waitFor();
await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(done))));
const usable = (performance.now() - from) / 1000;
/** From the event until the next picture is drawn. */
const find = (text) => page.evaluate((words) => new Promise((done) => {
  const field = document.querySelector('#find'), start = performance.now();
  field.value = words;
  field.dispatchEvent(new Event('input', { bubbles: true }));
  requestAnimationFrame(() => setTimeout(() => done(performance.now() - start)));
}), text);
const median = (all) => [...all].sort((p, q) => p - q)[Math.floor(all.length / 2)];
const kQueries = ['model 7', 'model 7 light', 'n = 16', 'exponent > 100', 'n > 10 light', 'change = worse', 'max_rel_peak > 0.0003', ''];
const times = new Map(kQueries.map((text) => [text, []]));
for (let round = 0; round < 5; ++round)
  for (const text of kQueries) { times.get(text).push(await find(text)); await page.waitForTimeout(100); }
const found = [...times].map(([text, all]) => ({ text, took: median(all) })), slowest = found.reduce((p, q) => (p.took > q.took ? p : q));
for (const { text, took } of found) console.log(`Find "${text}": ${took.toFixed(0)} ms`);
const full = await memory(), clicked = performance.now();
await page.locator('.cell > a').first().click();
await page.locator('h1', { hasText: 'model' }).waitFor();
const opened = (performance.now() - clicked) / 1000;
await browser.close();

console.log(`\n${'figure'.padEnd(34)}${'measured'.padStart(12)}${'goal'.padStart(10)}`);
const row = (name, value, unit, goal, digits = 0) => console.log(name.padEnd(34) + `${value.toFixed(digits)} ${unit}`.padStart(12)
  + (goal === undefined ? '' : `${goal} ${unit}`.padStart(10) + (value < goal ? '  met' : '  NOT MET')));
row('files', files.length, '', 2000);
row('size of the site', megabytes, 'MB', 100, 1);
row('usable after', usable, 's', 3, 2);
row('Find, slowest query, median of 5', slowest.took, 'ms', 100);
// An empty page costs most of the browser's memory, so the goal is for the page's process and all that the others grow by.
row('memory: page and growth', full.page + Math.max(0, full.all - full.page - (empty.all - empty.page)), 'MB', 300);
row("memory: page's process", full.page, 'MB');
row('memory: whole browser', full.all, 'MB');
row('memory: browser with empty page', empty.all, 'MB');
row("a cell's page after", opened, 's', undefined, 2);
