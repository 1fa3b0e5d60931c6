// Interactive additions to pages that are complete without them.
import './style/main.css';
import { addCopyButtons } from './lib/copy';
import './lib/data';
import views from './views';

// The scripts with the data come after this one and before this event.
addEventListener('DOMContentLoaded', () => {
  document.documentElement.classList.add('scripted');
  const main = document.querySelector('main');
  const name = document.body.dataset['view'];
  if (!main || !name) return;
  if (Object.hasOwn(views, name)) views[name]?.(main);
  addCopyButtons();
});
