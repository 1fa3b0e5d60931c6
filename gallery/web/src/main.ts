// Interactive additions to pages that are complete without them.
import './style/main.css';
import { addCopyButtons } from './lib/copy';
import { receive } from './lib/data';
import { openPage } from './lib/single_file';
import views from './views';

// The scripts with the data come after this one and before this event.
addEventListener('DOMContentLoaded', () => {
  document.documentElement.classList.add('scripted');
  const main = document.querySelector('main');
  if (!main) return;
  openPage(main, receive);
  const name = document.body.dataset['view'];
  if (!name) return;
  if (Object.hasOwn(views, name)) views[name]?.(main);
  addCopyButtons();
});
