// A copy button on commands and hashes.
import { button } from './dom';

export function addCopyButtons(): void {
  if (!navigator.clipboard) return;
  for (const place of document.querySelectorAll<HTMLElement>('pre.command, code.copied')) {
    const text = place.textContent ?? '';
    const what = place.dataset['what'] ?? 'the command';
    const control = button('Copy', () => {
      navigator.clipboard.writeText(text).then(
        () => { control.textContent = 'Copied'; },
        () => { control.textContent = 'Select and copy by hand'; });
    }, { class: 'copy', 'aria-label': `Copy ${what}` });
    if (place.tagName === 'PRE') {
      place.classList.add('copyable');
      place.append(control);
    } else {
      place.after(control);
    }
  }
}
