// Pictures of every view of a gallery, to look at: `node screenshots.mjs SITE OUT` writes OUT/VIEW-1440.png and OUT/VIEW-390.png.
import { mkdirSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { close, fileUrl, launch, open } from './test/browser.mjs';

const [site, out] = process.argv.slice(2);
if (!site || !out) {
  console.error('screenshots.mjs: SITE OUT');
  process.exit(2);
}
const pages = readdirSync(site).filter((name) => name.endsWith('.html')).map((name) => [name.replace('.html', ''), name]);
const browser = await launch();
mkdirSync(out, { recursive: true });
const first = await open(browser, fileUrl(site) + 'index.html');
const cell = await first.locator('.findings a[href^="cells/"], .grid-box a[href^="cells/"]').first().getAttribute('href');
if (cell) pages.push(['cell', cell]);
await close(first);
for (const width of [1440, 390])
  for (const [name, address] of pages) {
    const page = await open(browser, fileUrl(site) + address, { viewport: { width, height: 1400 }, ...(width < 500 ? { hasTouch: true, isMobile: true } : {}) });
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 500))));
    const file = path.join(out, `${name}-${width}.png`);
    // The grid's box is as high as the window, so a page with it has no end.
    await page.screenshot({ path: file, fullPage: await page.locator('.grid-box').count() === 0 });
    console.log(file);
    await close(page);
  }
await browser.close();
