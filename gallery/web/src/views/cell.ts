// The page of a cell: a viewer in place of the row of pictures, and curves that can be read.
import type { CellData } from '../cell/data';
import { profileView } from '../cell/profile_view';
import { Viewer, viewerState } from '../cell/viewer';
import { pageData } from '../lib/data';

export function cell(main: HTMLElement): void {
  const data = pageData<CellData>();
  if (!data) return;
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
