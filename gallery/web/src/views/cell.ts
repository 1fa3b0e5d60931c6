// The page of a cell: a viewer in place of the row of pictures, and an interactive profile.
import type { CellPage } from '../records';
import { profileView } from '../cell/profile_view';
import { linkState } from '../cell/choice';
import { Viewer } from '../cell/viewer';
import { pageData } from '../lib/data';
import { kPlaces } from '../lib/state';

/** Links to other cells keep the state of this page. */
function takeStateAlong(main: HTMLElement): void {
  const take = (event: Event): void => {
    const link = event.target instanceof Element ? event.target.closest<HTMLAnchorElement>('nav.axes a') : null;
    if (!link) return;
    const state = new URLSearchParams(location.hash.includes('=') ? location.hash.slice(1) : '');
    for (const [name, value] of new URLSearchParams(link.hash.slice(1))) if (kPlaces.includes(name)) state.set(name, value);
    link.hash = state.toString();
  };
  for (const kind of ['pointerdown', 'focusin', 'click'] as const) main.addEventListener(kind, take);
}

export function cell(main: HTMLElement): void {
  const data = pageData<CellPage>();
  if (data) showCell(main, data);
}

export function showCell(main: HTMLElement, data: CellPage): void {
  takeStateAlong(main);
  const state = linkState();
  const pictures = main.querySelector('section.pictures');
  if (pictures && data.engines.some((e) => e.picture)) {
    const viewer = new Viewer(data, state).element;
    pictures.before(viewer);
    pictures.classList.add('without-script');
    // Not by its hash, which is the state of the page.
    main.querySelector('a.skip')?.addEventListener('click', (event) => {
      event.preventDefault();
      viewer.querySelector<HTMLElement>('.stage')?.focus();
    });
  }
  const curves = main.querySelector('#profile')?.parentElement;
  const profile = profileView(data, state);
  if (curves && profile) {
    curves.querySelector('h2')?.after(profile);
    for (const figure of curves.querySelectorAll('figure:not(.scripted-only)')) figure.classList.add('without-script');
  }
}
