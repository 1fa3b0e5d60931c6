// The paper's claims, filtered by verdict and words.
import { h, select } from '../lib/dom';
import { addDrawnChartButtons } from '../lib/drawn_chart';
import { HashState } from '../lib/state';

export function paper(main: HTMLElement): void {
  addDrawnChartButtons(main);
  const claims = [...main.querySelectorAll<HTMLElement>('.claim')];
  const section = main.querySelector('.claims h2');
  if (!section || claims.length === 0) return;
  const state = new HashState({ verdict: '', find: '' });
  const count = h('output', { class: 'count' });
  const find = h('input', { type: 'search', id: 'find', 'aria-keyshortcuts': '/' });
  const words = new Map(claims.map((claim) => [claim, (claim.textContent ?? '').toLowerCase()]));
  const verdicts = [...new Set(claims.map((claim) => claim.dataset['verdict'] ?? ''))];
  const verdict = select('Verdict', [{ value: '', label: 'any' }, ...verdicts.map((v) => ({ value: v, label: v }))], '',
    (value) => { state.set({ verdict: value }); refresh(); });
  find.addEventListener('input', () => { state.set({ find: find.value }); refresh(); });
  document.addEventListener('keydown', (event) => {
    if (event.key !== '/' || event.target instanceof HTMLInputElement || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    find.focus();
  });
  section.after(h('div', { class: 'controls claim-bar', role: 'search', 'aria-label': 'Claims' },
    h('label', {}, h('span', {}, 'Find'), find), verdict.element, count));

  function refresh(): void {
    const wanted = state.get('find').toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const claim of claims) {
      const fits = (state.get('verdict') === '' || claim.dataset['verdict'] === state.get('verdict')) &&
        wanted.every((word) => words.get(claim)?.includes(word));
      claim.hidden = !fits;
      if (fits) ++shown;
    }
    count.textContent = `showing ${shown} of ${claims.length}`;
    verdict.set(state.get('verdict'));
    if (find.value !== state.get('find')) find.value = state.get('find');
  }
  // A link to a claim that is filtered out clears the filters.
  addEventListener('hashchange', () => {
    if (document.getElementById(location.hash.slice(1))?.hidden) { state.set({ verdict: '', find: '' }); refresh(); }
  });
  state.onChange(refresh);
  refresh();
}
