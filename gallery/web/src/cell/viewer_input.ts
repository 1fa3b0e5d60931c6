// Pointer and keys of a cell's viewer.
import { announce, isTyping } from '../lib/dom';
import { clamp, numberText } from '../lib/numbers';
import { kHold, type Flipper } from './flipper';
import type { LinkState } from './choice';
import type { ViewerState } from './viewer_state';

/** What pointer and keys do. */
export interface Controls {
  readonly stage: HTMLElement;
  readonly state: ViewerState;
  readonly flipper: Flipper;
  /** A line. */
  readonly isDrawing: boolean;
  change(changes: Parameters<LinkState['set']>[0]): void;
  setMode(mode: string): void;
  /** `keep`: the link gets it too. */
  setCursor(x: number, y: number, keep?: boolean): void;
  startLine(): void;
  fill(): void;
  nextPicture(by: 1 | -1): void;
  exchange(): void;
  showOldAgainstNew(): void;
  goToWorst(): void;
}

const kStill = 4;  // pixels of the page that a click may move

export function listenToPointer(viewer: Controls): void {
  const { stage, state } = viewer, { camera, choice } = state;
  let held: { x: number; y: number; kind: 'pan' | 'line' | 'split' } | undefined;
  let still: { x: number; y: number; timer: number } | undefined;  // a press in flip mode that has not moved
  const fingers = new Map<number, PointerEvent>();
  const letGo = (): boolean => {
    if (!still) return false;
    window.clearTimeout(still.timer);
    still = undefined;
    return true;
  };
  /** Two fingers keep their points of the picture. */
  const pinch = (event: PointerEvent): void => {
    const other = [...fingers.values()].find((one) => one.pointerId !== event.pointerId)!, before = fingers.get(event.pointerId)!;
    const distance = (to: PointerEvent) => Math.max(1, Math.hypot(to.clientX - other.clientX, to.clientY - other.clientY));
    camera.zoomBy(distance(event) / distance(before), camera.pointAt(other));
  };
  const isAtDivider = (event: PointerEvent): boolean => {
    const box = stage.getBoundingClientRect();
    return choice.mode() === 'slide' && Math.abs(event.clientX - box.left - box.width * choice.state.number('split') / 100) < 12;
  };
  stage.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    fingers.set(event.pointerId, event);
    if (fingers.size === 2) {
      letGo();
      held = undefined;
      return stage.setPointerCapture(event.pointerId);
    }
    const point = camera.pointAt(event);
    held = { ...point, kind: viewer.isDrawing ? 'line' : isAtDivider(event) ? 'split' : 'pan' };
    stage.setPointerCapture(event.pointerId);
    if (choice.mode() === 'flip' && held.kind === 'pan')
      still = { x: event.clientX, y: event.clientY, timer: window.setTimeout(() => { still = undefined; viewer.flipper.peek(true); }, kHold) };
  });
  stage.addEventListener('pointermove', (event) => {
    if (fingers.size === 2) pinch(event);
    if (fingers.has(event.pointerId)) fingers.set(event.pointerId, event);
    if (fingers.size === 2) return;
    if (still && Math.hypot(event.clientX - still.x, event.clientY - still.y) > kStill) letGo();
    const point = camera.pointAt(event);
    viewer.setCursor(point.x, point.y);
    stage.classList.toggle('at-divider', held?.kind === 'split' || (!held && isAtDivider(event)));
    if (!held) return;
    if (held.kind === 'line') {
      viewer.change({ line: [held.x, held.y, point.x, point.y].map((v, i) => clamp(Math.floor(v), 0, (i % 2 ? camera.size.height : camera.size.width) - 1)).join(',') });
    } else if (held.kind === 'split') {
      const box = stage.getBoundingClientRect();
      viewer.change({ split: clamp(100 * (event.clientX - box.left) / box.width, 0, 100).toFixed(1) });
    } else {
      camera.moveBy(held.x - point.x, held.y - point.y);
    }
  });
  const release = (event: PointerEvent): void => {
    fingers.delete(event.pointerId);
    if (letGo() && event.type === 'pointerup') viewer.flipper.flip();
    viewer.flipper.peek(false);
    if (held?.kind === 'line') viewer.startLine();
    else if (held?.kind === 'pan' && state.cursor) viewer.setCursor(state.cursor.x, state.cursor.y, true);
    held = undefined;
  };
  stage.addEventListener('pointerup', release);
  stage.addEventListener('pointercancel', release);
  stage.addEventListener('wheel', (event) => {
    // Without Ctrl the page scrolls, unless the reader is at work on the picture.
    if (!event.ctrlKey && document.activeElement !== stage) return;
    event.preventDefault();
    camera.zoomBy(2 ** (-event.deltaY / 240), camera.pointAt(event));
  }, { passive: false });
  stage.addEventListener('dblclick', (event) => camera.zoomBy(2, camera.pointAt(event)));
}

export function listenToKeys(viewer: Controls): void {
  viewer.stage.addEventListener('keydown', (event) => moveByKey(viewer, event));
  document.addEventListener('keydown', (event) => actByKey(viewer, event));
}

/** Arrow keys on the stage. */
function moveByKey(viewer: Controls, event: KeyboardEvent): void {
  const { state } = viewer, { camera, choice } = state;
  const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
  if (!step) return;
  event.preventDefault();
  const [dx = 0, dy = 0] = step;
  if (event.shiftKey) {
    const stride = camera.rectangles()[0]!.width / camera.view().zoom / 8;
    return camera.moveBy(dx * stride, dy * stride);
  }
  const { x, y } = state.cursorOrMiddle();
  viewer.setCursor(x + dx, y + dy, true);
  const ours = state.pictures.valueAt(choice.engine('a'), state.cursor!.x, state.cursor!.y);
  if (ours) announce(`Pixel ${state.cursor!.x}, ${state.cursor!.y}: ${ours.map((v) => numberText(v)).join(', ')}`);
}

/** Letters and digits anywhere on the page. */
function actByKey(viewer: Controls, event: KeyboardEvent): void {
  const { state } = viewer, { camera, choice } = state;
  if (isTyping(event)) return;
  const cell = event.key === 'j' ? 'next' : event.key === 'k' ? 'prev' : undefined;
  if (cell) return [...document.querySelectorAll<HTMLAnchorElement>(`nav.axes a[rel=${cell}]`)].at(-1)?.click();
  const digit = /^(?:Digit|Numpad)([1-9])$/.exec(event.code)?.[1];
  const picked = digit ? choice.data.engines[Number(digit) - 1] : undefined;
  if (picked?.picture) {
    viewer.change(event.shiftKey ? { b: picked.name } : { a: picked.name, shown: 'a' });
    announce(picked.title);
    return event.preventDefault();
  }
  const isDifference = choice.mode() === 'diff';
  const stops = (): number => (isDifference ? choice.gain() : choice.stops());
  const setStops = (value: number): void => viewer.change({ [isDifference ? 'gain' : 'ev']: String(value) });
  const brighten = (by: number): void => {
    setStops(stops() + by);
    setStops(stops());  // which is within the limits
  };
  const acts: Record<string, () => void> = {
    f: () => viewer.flipper.flip(), t: () => viewer.flipper.blink(), m: () => viewer.fill(),
    l: () => viewer.setMode('slide'), s: () => viewer.setMode('side'), d: () => viewer.setMode('diff'),
    ',': () => viewer.nextPicture(-1), '.': () => viewer.nextPicture(1),
    x: () => viewer.exchange(), b: () => viewer.showOldAgainstNew(),
    e: () => brighten(0.5), E: () => brighten(-0.5),
    Escape: () => { viewer.flipper.stop(); if (viewer.isDrawing) viewer.startLine(); },
    c: () => viewer.change({ colour: choice.state.get('colour') === 'false' ? '' : 'false' }),
    '+': () => camera.zoomBy(2), '=': () => camera.zoomBy(2), '-': () => camera.zoomBy(0.5), '0': () => camera.fit(), h: () => camera.goHome(),
    p: () => viewer.startLine(), w: () => viewer.goToWorst(),
  };
  const act = Object.hasOwn(acts, event.key) ? acts[event.key] : undefined;
  if (!act) return;
  act();
  event.preventDefault();
}
