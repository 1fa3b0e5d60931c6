// The page of all cells of a large site. The hash names the cell: cell.html#cell=ID&mode=flip.
import { openCell, type OpenedCell } from '../cell/packed_cell';
import { addCopyButtons } from '../lib/copy';
import { pageData } from '../lib/data';
import { h } from '../lib/dom';
import type { CellIndex } from '../records';
import { showCell } from './cell';

const asked = (): string => new URLSearchParams(location.hash.slice(1)).get('cell') ?? '';

export function packed(main: HTMLElement): void {
  const index = pageData<CellIndex>(), hash = location.hash, id = asked();
  document.body.className = 'view-cell';
  addEventListener('hashchange', () => {
    // An anchor, such as that of the skip link, is no cell.
    if (!location.hash.includes('=')) history.replaceState(history.state, '', hash);
    else if (asked() !== id) location.reload();
  });
  if (!index) return say(main, 'The data of this page cannot be read', 'cell.data.js is missing or damaged.');
  openCell(index, id).then((cell) => {
    if (cell) show(main, cell);
    else say(main, 'No such cell', id === '' ? 'The link names no cell.' : `This gallery has no cell “${id}”.`);
  }, (error: unknown) => say(main, 'The cell cannot be read', error instanceof Error ? error.message : String(error)));
}

function show(main: HTMLElement, { page, markup, pictures }: OpenedCell): void {
  const { body } = new DOMParser().parseFromString(markup, 'text/html');
  for (const image of body.querySelectorAll('img')) image.src = pictures.get(image.getAttribute('src') ?? '') ?? '';
  main.replaceChildren(...body.childNodes);
  document.title = document.title.replace(/^Cell(?= · |$)/, () => page.label || page.id);
  showCell(main, page);
  addCopyButtons();
}

function say(main: HTMLElement, title: string, words: string): void {
  main.replaceChildren(h('h1', {}, title), h('p', { class: 'absent' }, words), h('p', {}, h('a', { href: 'index.html' }, 'All cells')));
}
