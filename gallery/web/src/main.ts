// Comforts; every page is complete without them.
import './style/main.css';
import { addCopyButtons } from './lib/copy';
import './lib/data';
import views from './views';

// The data's scripts stand after this one, and this event after all of them.
addEventListener('DOMContentLoaded', () => {
  document.documentElement.classList.add('scripted');
  const main = document.querySelector('main');
  const name = document.body.dataset['view'];
  if (!main || !name) return;
  if (Object.hasOwn(views, name)) views[name]?.(main);
  addCopyButtons();
});
