// Two pictures in turn, in one place: by click or key, while something is held, and by a timer.
import { announce, button } from '../lib/dom';
import type { Choice } from './choice';

const kPeriod = 700;  // ms a picture: under three changes a second
export const kHold = 350;  // ms after which a press shows the other picture only while it lasts

export class Flipper {
  readonly button = button('Blink', () => this.blink(), { title: 'The two in turn, by a timer (t)', 'aria-keyshortcuts': 't', 'aria-pressed': 'false' });
  private timer: number | undefined;
  private isPeeking = false;

  constructor(private readonly choice: Choice, private readonly change: (changes: { mode: 'flip'; shown: 'a' | 'b' }) => void) {}

  /** Tells which one is seen, unless a timer would tell it without end. */
  flip(isTold = true): void {
    const { choice } = this, isFlip = choice.mode() === 'flip';
    const shown = isFlip && choice.state.get('shown') === 'a' ? 'b' : 'a';
    this.change({ mode: 'flip', shown });
    if (isTold) announce(choice.data.engines[choice.engine(shown)]?.title ?? '');
  }

  /** The other picture, for as long as it lasts. */
  peek(isOn: boolean): void {
    if (isOn === this.isPeeking) return;
    this.isPeeking = isOn;
    this.flip(isOn);
  }

  blink(): void {
    if (this.timer !== undefined) return this.stop();
    this.timer = window.setInterval(() => { if (this.choice.mode() === 'flip') this.flip(false); else this.stop(); }, kPeriod);
    this.flip(false);
    this.button.setAttribute('aria-pressed', 'true');
    announce('The two are shown in turn. Escape ends it.');
  }

  stop(): void {
    if (this.timer === undefined) return;
    window.clearInterval(this.timer);
    this.timer = undefined;
    this.button.setAttribute('aria-pressed', 'false');
  }
}
