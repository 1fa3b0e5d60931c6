// The page on cost: pointing at a variant marks it in its table and in all charts of that table.
import { addDrawnChartButtons } from '../lib/drawn_chart';

export function cost(main: HTMLElement): void {
  addDrawnChartButtons(main);
  for (const section of main.querySelectorAll<HTMLElement>('section[id^="table-"]')) {
    const details = section.querySelector<HTMLDetailsElement>('details.variants');
    if (details) details.open = true;
    const all = [...section.querySelectorAll<HTMLElement | SVGElement>('[data-key]')];
    const mark = (key?: string): void => {
      for (const element of all) element.classList.toggle('marked', element.dataset['key'] === key);
    };
    section.addEventListener('pointerover', ({ target }) => {
      mark(target instanceof Element ? target.closest<HTMLElement | SVGElement>('[data-key]')?.dataset['key'] : undefined);
    });
    section.addEventListener('pointerleave', () => mark());
  }
}
