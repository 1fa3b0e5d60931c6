// A published site of four cells, and the page of one, for a file of tests.
import path from 'node:path';
import { after, before } from 'node:test';
import { fileUrl, launch, lobelia, open, ready, scratch } from './browser.mjs';
import { writeFarm } from './farm.mjs';

export const kCell = 'cells/phong-16/index.html';

/** `browser` is there when a test runs. */
export function cellSite(options = {}) {
  const directory = scratch(), run = path.join(directory, 'run'), site = path.join(directory, 'site'), here = { directory, run, site };
  before(async () => {
    writeFarm(run, { axes: { model: ['phong', 'blinn'], exponent: ['16', '128'] }, ...options });
    lobelia('gallery', run, '-o', site);
    here.browser = await launch();
  });
  after(() => here.browser?.close());
  here.cellPage = async (hash = '', count = 2, how = {}) => {
    const page = await open(here.browser, fileUrl(site) + kCell + hash, how);
    await ready(page, count);
    return page;
  };
  return here;
}

/** Each value is near the one that is wanted. */
export const near = (seen, wanted, by = 2) =>
  seen.forEach((v, i) => { if (!(Math.abs(v - wanted[i]) <= by)) throw new Error(`${seen} is not ${wanted}`); });
/** Just right of and below the middle: in pixel (32, 32) of 64 x 64. */
export const middle = async (stage) => { const box = await stage.boundingBox(); return { x: box.width / 2 + 2, y: box.height / 2 + 2 }; };
