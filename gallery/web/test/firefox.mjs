// A gallery in Debian's Firefox, driven by WebDriver BiDi: Playwright drives no Firefox but its own.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import puppeteer from 'puppeteer-core';

/** Milliseconds that only a hang takes. */
const kHang = 600_000;

/** Headless and with a profile of its own. Saves files in `downloads`. */
export const launchFirefox = (downloads) => puppeteer.launch({
  browser: 'firefox', executablePath: '/usr/bin/firefox-esr', headless: true, timeout: kHang, protocolTimeout: kHang,
  extraPrefsFirefox: {
    'browser.download.folderList': 2, 'browser.download.dir': downloads, 'browser.download.useDownloadDir': true,
    'browser.download.alwaysOpenPanel': false, 'ui.prefersReducedMotion': 1,
  },
});

/** A page, with everything that must not happen made a failure of close(). */
export async function open(browser, url, { width = 1280, height = 900 } = {}) {
  const page = await browser.newPage();
  page.setDefaultTimeout(kHang);
  const problems = [], origin = new URL(url);
  // Firefox warns of a missing WebGL itself.
  page.on('console', (message) => { if (['error', 'warn'].includes(message.type()) && !/WebGL/.test(message.text())) problems.push(message.text()); });
  page.on('pageerror', (error) => problems.push(String(error)));
  page.on('dialog', (dialog) => { problems.push('dialog ' + dialog.message()); void dialog.dismiss(); });
  page.on('request', (request) => {
    const to = new URL(request.url());
    if (!['data:', 'blob:'].includes(to.protocol) && (to.protocol !== origin.protocol || to.host !== origin.host)) problems.push('asked ' + request.url());
  });
  page.problems = problems;
  await page.setViewport({ width, height });
  await page.goto(url);
  return page;
}

export async function close(page) {
  assert.deepEqual(page.problems, []);
  await page.close();
}

export const textOf = (page, selector) => page.$eval(selector, (element) => element.textContent);

export async function says(page, selector, pattern) {
  await page.waitForFunction((s, source) => new RegExp(source).test(document.querySelector(s)?.textContent ?? ''), { polling: 50 }, selector, pattern.source);
}

/** Presses the button of this name. */
export async function press(page, name) {
  const button = await page.waitForSelector(`::-p-xpath(//button[normalize-space()=${JSON.stringify(name)} or @aria-label=${JSON.stringify(name)}])`);
  await button.scrollIntoView();
  await button.click();
}

/** The file that `act` saves. */
export async function saved(directory, act) {
  const before = new Set(readdirSync(directory));
  await act();
  for (const end = Date.now() + kHang; Date.now() < end;) {
    const name = readdirSync(directory).find((one) => !before.has(one) && !one.endsWith('.part'));
    const file = name && path.join(directory, name);
    // Firefox makes an empty file first and fills it by a rename.
    if (file && !existsSync(file + '.part') && readFileSync(file).length > 0) return { name, bytes: readFileSync(file) };
    await new Promise((done) => setTimeout(done, 50));
  }
  throw new Error('nothing was saved');
}

/** Colours of the stage as a person sees them: shares of its width and height, and [r, g, b] for each. */
export async function seen(page, places) {
  const stage = await page.$('.stage');
  const picture = Buffer.from(await stage.screenshot()).toString('base64');
  // The page's policy allows data: pictures.
  return page.evaluate(async (data, all) => {
    const image = new Image();
    image.src = 'data:image/png;base64,' + data;
    await image.decode();
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width: image.width, height: image.height });
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    return all.map(([x, y]) => [...context.getImageData(Math.floor(x * image.width), Math.floor(y * image.height), 1, 1).data.slice(0, 3)]);
  }, picture, places);
}
