// A report in one file: all other files of the site are elements of the page, with JSON inside (gallery/pages/single_file.cpp).
// The hash names the page that is shown: #page=cells/a/index.html&mode=flip.

import type { InlinedPage } from '../records';

export interface InlinedData { readonly name: string; readonly data: unknown }

/** The page that the file opens with: its index, or the only one. */
const first = document.querySelector('main')?.getAttribute('data-page') ?? 'index.html';
let files: Map<string, Element> | undefined;
let page = first;

function allFiles(): Map<string, Element> {
  files ??= new Map([...document.querySelectorAll('script[data-file]')].map((e) => [e.getAttribute('data-file') ?? '', e]));
  return files;
}

/** The path from the site's directory to a file named on the page that is shown. */
function pathOf(source: string): string {
  const base = new URL(page, 'site:///');
  return decodeURIComponent(new URL(source, base).pathname).replace(/^\/+/, '');
}

/** The element that holds a file of the site, named on the page that is shown. */
const fileAt = (source: string): Element | undefined => (allFiles().size === 0 ? undefined : files!.get(pathOf(source)));

/** The data of a script that this file holds. */
export function inlined(source: string): InlinedData | undefined {
  const at = fileAt(source);
  return at ? { name: at.getAttribute('data-name') ?? '', data: JSON.parse(at.textContent ?? '') } : undefined;
}

/** A picture's address: a file beside the page, or what this file holds of it. */
export const pictureAt = (source: string): string => fileAt(source)?.textContent ?? source;

/** A page's address. */
export const pageAt = (source: string): string => (allFiles().size === 0 ? source : '#page=' + pathOf(source));

const pageInHash = (): string => {
  const asked = new URLSearchParams(location.hash.slice(1)).get('page') ?? first;
  return allFiles().has(asked) ? asked : first;
};

/** Puts the page that the hash names into <main>. Does nothing on a page of a site of many files. */
export function openPage(main: HTMLElement, receive: (data: InlinedData) => void): void {
  if (allFiles().size === 0) return;
  page = pageInHash();
  const shown = JSON.parse(allFiles().get(page)?.textContent ?? 'null') as InlinedPage | null;
  if (!shown) return;
  const markup = new DOMParser().parseFromString(shown.main, 'text/html');
  for (const image of markup.querySelectorAll('img')) image.setAttribute('src', pictureAt(image.getAttribute('src') ?? ''));
  for (const link of markup.querySelectorAll('a')) {
    const to = link.getAttribute('href') ?? '';
    if (allFiles().has(pathOf(to)) && to.endsWith('.html')) link.setAttribute('href', pageAt(to));
    else if (!to.startsWith('#')) link.removeAttribute('href');
  }
  main.replaceChildren(...markup.body.childNodes);
  document.title = shown.title;
  document.body.dataset['view'] = shown.view;
  document.body.className = 'view-' + shown.view;
  const data = inlined(shown.view === 'grid' ? 'grid.data.js' : 'data.js');
  if (data) receive(data);
  // A page begins as a page of its own does, without the listeners of the one before.
  addEventListener('hashchange', () => { if (pageInHash() !== page) location.reload(); });
}
