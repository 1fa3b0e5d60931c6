// The hard cases: charts as figures.
import { addDrawnChartButtons } from '../lib/drawn_chart';

export function stability(main: HTMLElement): void {
  addDrawnChartButtons(main);
}
