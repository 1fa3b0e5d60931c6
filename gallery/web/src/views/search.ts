// The page on the cheapest lobes: what the page on cost does, and a slider for the exponent.
import { h } from '../lib/dom';
import { cost } from './cost';

export function search(main: HTMLElement): void {
  const figures = [...main.querySelectorAll<HTMLElement>('figure[data-exponent]')];
  for (const figure of figures) figure.hidden = false;  // what is hidden has no places
  cost(main);
  if (figures.length < 2) return;
  const slider = h('input', { type: 'range', min: 0, max: figures.length - 1, value: 0 });
  const shown = h('output');
  const show = (): void => {
    const at = Number(slider.value);
    figures.forEach((figure, i) => { figure.hidden = i !== at; });
    shown.textContent = figures[at]?.dataset['exponent'] ?? '';
    slider.setAttribute('aria-valuetext', shown.textContent);
  };
  slider.addEventListener('input', show);
  figures[0]!.before(h('label', { class: 'exponent' }, 'Exponent ', slider, ' ', shown));
  show();
}
