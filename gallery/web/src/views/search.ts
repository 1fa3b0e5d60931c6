// The page on the cheapest lobes: what the page on cost does.
import { cost } from './cost';

export function search(main: HTMLElement): void {
  cost(main);
}
