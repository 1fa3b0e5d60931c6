// A gallery in Debian's Chromium, from file:// and from a server, with everything that must not happen
// made a failure: complaints, requests elsewhere, dialogs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const web = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '..');
export const program = process.env.LOBELIA_PROGRAM ?? path.resolve(web, '../../build/release/bin/lobelia');
const axe = path.join(web, 'node_modules/axe-core/axe.min.js');

/** Milliseconds that only a hang takes. */
const kHang = 600_000;

export const lobelia = (...args) => execFileSync(program, args, { encoding: 'utf8' });

/** A directory that goes with the process. */
export function scratch() {
  const directory = mkdtempSync(path.join(tmpdir(), 'lobelia-web-'));
  process.on('exit', () => rmSync(directory, { recursive: true, force: true }));
  return directory;
}

/** A server of static files, as `python3 -m http.server --bind 127.0.0.1` is one. */
export async function serve(site) {
  const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.png': 'image/png', '.svg': 'image/svg+xml', '.json': 'application/json' };
  const server = createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, 'http://127.0.0.1').pathname);
    try {
      const file = path.join(site, name.endsWith('/') ? name + 'index.html' : name);
      const content = readFileSync(file);
      response.writeHead(200, { 'Content-Type': types[path.extname(file)] ?? 'application/octet-stream' }).end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  server.unref();
  return { url: `http://127.0.0.1:${server.address().port}/`, stop: () => new Promise((done) => { server.close(done); server.closeAllConnections?.(); }) };
}

export const fileUrl = (site) => pathToFileURL(site).href + '/';

/** SwiftShader draws WebGL where there is no graphics processor. Pages are put together without it. */
const options = (args) => ({
  executablePath: '/usr/bin/chromium',
  timeout: kHang,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage', '--disable-gpu-compositing', ...args],
});
export const launch = (args = []) => chromium.launch(options(args));

/** A browser that kill() ends even while a shader of it runs for ever. */
export async function launchToKill() {
  const server = await chromium.launchServer(options([]));
  return { browser: await chromium.connect(server.wsEndpoint()), kill: () => server.kill() };
}

export async function open(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: 'reduce', ...options });
  context.setDefaultTimeout(kHang);
  const page = await context.newPage();
  const problems = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|swiftshader|willReadFrequently/i.test(message.text())) problems.push(message.text()); });
  page.on('pageerror', (error) => problems.push(String(error)));
  page.on('dialog', (dialog) => { problems.push('dialog ' + dialog.message()); void dialog.dismiss(); });
  page.requested = new Set();
  const origin = new URL(url);
  page.on('request', (request) => {
    const to = new URL(request.url());
    page.requested.add(request.url());
    if (to.protocol !== 'data:' && (to.protocol !== origin.protocol || to.host !== origin.host)) problems.push('asked ' + request.url());
  });
  page.problems = problems;
  await page.goto(url);
  return page;
}

/** Nothing that open() listens for has happened. */
export async function close(page) {
  assert.deepEqual(page.problems, []);
  await page.context().close();
}

export async function requireAccessible(page, what) {
  // As a string through the debugger: the page's own policy lets no script in.
  await page.evaluate(readFileSync(axe, 'utf8') + ';0');
  const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ['violations'], preload: false }));
  assert.deepEqual(violations.map((v) => `${what}: ${v.id}: ${v.nodes.slice(0, 3).map((n) => n.target.join(' ') + ' ' + n.failureSummary).join('; ')}`), []);
}

/** Waits until the text of the first such element fits: pages paint when the browser is ready to. */
export async function says(page, selector, pattern) {
  const text = async () => (await page.locator(selector).first().textContent()) ?? '';
  for (const end = Date.now() + kHang; Date.now() < end;) {
    if (pattern.test(await text())) return;
    await page.waitForTimeout(20);
  }
  assert.match(await text(), pattern);
}

/** As the page has it now; page.url() hears of a change later. */
export const address = (page) => page.evaluate(() => location.href);
/** What the link says after its '#'. */
export const hashOf = (page) => page.evaluate(() => Object.fromEntries(new URLSearchParams(location.hash.slice(1))));

/** A click on the stage that is never taken for a held press, however long a busy machine makes it last. */
export async function clickStage(page, x, y) {
  const hold = Number(/kHold = (\d+)/.exec(readFileSync(path.join(web, 'src/cell/flipper.ts'), 'utf8'))[1]);
  await page.evaluate((ms) => {
    const set = window.setTimeout;
    window.setTimeout = (act, after, ...rest) => (after === ms ? 0 : set(act, after, ...rest));
    window.endClick = () => { window.setTimeout = set; };
  }, hold);
  await page.mouse.click(x, y);
  await page.evaluate(() => window.endClick());
}

/** The viewer has its float pictures. */
export const ready = (page, count = 2) => page.waitForFunction((n) => Number(document.querySelector('.stage')?.dataset.ready) >= n, count);

/** A pixel of the stage as it is seen, at shares of its width and height. */
export async function seenAt(page, shareX, shareY) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page.evaluate(([x, y]) => {
    const canvas = document.querySelector('.stage canvas');
    return [...canvas.getContext('2d').getImageData(Math.floor(x * canvas.width), Math.floor(y * canvas.height), 1, 1).data.subarray(0, 3)];
  }, [shareX, shareY]);
}
