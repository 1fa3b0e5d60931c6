// The views that have something to start on their page. A page names its own as <body data-view="...">.
import { cell } from './views/cell';
import { cost } from './views/cost';
import { explorer } from './views/explorer';
import { grid } from './views/grid';
import { paper } from './views/paper';
import { stability } from './views/stability';

/** Called once, when the page and its data are there. `main` holds the page as it is without script. */
export type View = (main: HTMLElement) => void;

export const views: Readonly<Record<string, View>> = {
  grid,
  cell,
  explorer,
  stability,
  paper,
  cost,
};
