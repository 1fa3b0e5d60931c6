// The table of all pictures' values at the pixel under the cursor.
import { h } from '../lib/dom';
import { shortText } from '../lib/numbers';
import { valueOfMap } from './maps';
import type { ViewerState } from './viewer_state';

export class PixelValues {
  private readonly rows = h('tbody');
  private readonly where = h('output', { class: 'where' });
  readonly element = h('table', { class: 'pixel-values' },
    h('caption', {}, this.where),
    h('thead', {}, h('tr', {}, ...['', 'red', 'green', 'blue'].map((c) => h('th', { scope: 'col' }, c || h('span', { class: 'unseen' }, 'picture'))))),
    this.rows);

  show(viewer: ViewerState, a: number, b: number): void {
    const cursor = viewer.cursorNow(a, b);
    if (!cursor || !viewer.isFloat) {
      this.where.textContent = viewer.isFloat ? 'Point at a pixel to read its values' : 'Values need float pictures';
      this.rows.replaceChildren();
      return;
    }
    const { x, y } = cursor;
    const worst = viewer.worstPixel(a, b);
    const isWorst = a !== b && worst?.x === x && worst.y === y && worst.value > 0;
    this.where.textContent = `Pixel (${x}, ${y})${isWorst ? ', where they differ most' : ''}`;
    const row = (name: string, value: readonly number[] | undefined, text: (value: number, c: number) => string, chosen: string): HTMLElement =>
      h('tr', { class: chosen }, h('th', { scope: 'row' }, name),
        ...[0, 1, 2].map((c) => h('td', {}, value ? text(value[c]!, c) : '…')));
    const { engines } = viewer.choice.data;
    // An earlier picture is loaded only if it is looked at.
    const rows = viewer.choice.engines().filter((i) => engines[i]!.floatScript && (!engines[i]!.beforeOf || i === a || i === b)).map((i) => {
      void viewer.pictures.need(i);
      return row(engines[i]!.shortTitle, viewer.pictures.valueAt(i, x, y), (value, c) => viewer.pictures.valueText(i, x, y, c, value), i === a || i === b ? 'chosen' : '');
    });
    rows.push(row('Difference', viewer.pictures.differenceAt(a, b, x, y), (value) => shortText(value), 'sum'));
    const map = viewer.mapOf(a, b), mapped = map && valueOfMap(map, x, y);
    if (map && mapped !== undefined)
      rows.push(h('tr', { class: 'sum' }, h('th', { scope: 'row' }, map.title), h('td', { colspan: 3 }, shortText(mapped, 3))));
    this.rows.replaceChildren(...rows);
  }
}
