// The page of a cell: a viewer in place of the row of pictures, and an interactive profile.
import type { CellPage } from '../records';
import { profileView } from '../cell/profile_view';
import { viewerState } from '../cell/choice';
import { Viewer } from '../cell/viewer';
import { pageData } from '../lib/data';

/** Links to other cells keep the state of this page. */
function takeStateAlong(main: HTMLElement): void {
  const take = (event: Event): void => {
    const link = event.target instanceof Element ? event.target.closest<HTMLAnchorElement>('nav.axes a') : null;
    if (!link) return;
    const state = new URLSearchParams(location.hash.includes('=') ? location.hash.slice(1) : '');
    const page = new URLSearchParams(link.hash.slice(1)).get('page');
    if (page !== null) state.set('page', page);
    link.hash = state.toString();
  };
  for (const kind of ['pointerdown', 'focusin', 'click'] as const) main.addEventListener(kind, take);
}

export function cell(main: HTMLElement): void {
  const data = pageData<CellPage>();
  if (!data) return;
  takeStateAlong(main);
  const state = viewerState();
  const pictures = main.querySelector('section.pictures');
  if (pictures && data.engines.some((e) => e.picture)) {
    pictures.before(new Viewer(data, state).element);
    pictures.classList.add('without-script');
  }
  const curves = main.querySelector('#profile')?.parentElement;
  const profile = profileView(data, state);
  if (curves && profile) {
    curves.querySelector('h2')?.after(profile);
    for (const figure of curves.querySelectorAll('figure:not(.scripted-only)')) figure.classList.add('without-script');
  }
}
