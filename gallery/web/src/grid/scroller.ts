// A box that scrolls over blocks of known heights and holds the elements of those in view alone.
import { h } from '../lib/dom';

/** What is in view, in pixels from the block's corner, and whether (1 or 0) a few cells beyond it are drawn, too. */
export interface Window { readonly top: number; readonly bottom: number; readonly left: number; readonly right: number; readonly spare: number }

export interface Block {
  readonly height: number;
  readonly width: number;
  make(): HTMLElement;
  /** Fills the element of make() with what is in this window, and more. */
  draw(at: Window): void;
}

/** Elements by number, made when they come into view and gone when they leave it, unless they have the focus. */
export class Live {
  private readonly elements = new Map<number, HTMLElement>();

  constructor(private readonly parent: HTMLElement) {}

  /** A reader of the page's order meets them in their own. */
  keep(from: number, to: number, make: (index: number) => HTMLElement): void {
    for (const [index, element] of this.elements) {
      if ((index >= from && index < to) || element.contains(document.activeElement)) continue;
      element.remove();
      this.elements.delete(index);
    }
    const after = Math.min(...[...this.elements.keys()].filter((index) => index >= to));
    for (let index = to - 1, next: HTMLElement | null = this.elements.get(after) ?? null; index >= from; --index) {
      const known = this.elements.get(index), element: HTMLElement = known ?? make(index);
      if (!known) { this.elements.set(index, element); this.parent.insertBefore(element, next); }
      next = element;
    }
  }

  has(index: number): boolean { return this.elements.has(index); }
}

export class Scroller {
  readonly box = h('div', { class: 'grid-box', role: 'region', tabindex: 0 });
  private readonly sizer = h('div', { class: 'grid-sizer' });
  private blocks: readonly Block[] = [];
  private tops = new Float64Array(1);
  private live = new Live(this.sizer);
  private isAsked = false;
  private isWhole = false;

  constructor(label: string) {
    this.box.setAttribute('aria-label', label);
    this.box.append(this.sizer);
    this.box.addEventListener('scroll', () => this.ask(), { passive: true });
    this.box.addEventListener('keydown', (event) => { if (event.key === 'Tab') this.wrap(event.shiftKey); });
    addEventListener('beforeprint', () => { this.isWhole = true; this.draw(); });
    addEventListener('afterprint', () => { this.isWhole = false; this.draw(); });
  }

  show(blocks: readonly Block[]): void {
    this.blocks = blocks;
    this.tops = new Float64Array(blocks.length + 1);
    let width = 0;
    blocks.forEach((block, i) => { this.tops[i + 1] = this.tops[i]! + block.height; width = Math.max(width, block.width); });
    this.sizer.style.height = `${this.tops[blocks.length]}px`;
    this.sizer.style.width = `${width}px`;
    this.sizer.replaceChildren();
    this.live = new Live(this.sizer);
    // Visible rows come first, so that typing in Find does not wait for the others.
    this.draw(0);
    setTimeout(() => this.ask());
  }

  private ask(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => { this.isAsked = false; this.draw(); });
  }

  /** Tab from the end of a row goes to the beginning of the next, which may not be drawn; and so back. */
  private wrap(isBack: boolean): void {
    const beside = (cell: Element | null | undefined) => isBack ? cell?.previousElementSibling : cell?.nextElementSibling;
    const cell = document.activeElement?.closest('td');
    if (!cell) return;
    for (let next = beside(cell); next; next = beside(next)) if (next.querySelector('a')) return;
    this.box.scrollLeft = isBack ? this.box.scrollWidth : 0;
    this.draw();
  }

  /** The first block that ends below `y`. */
  private blockAt(y: number): number {
    let low = 0, high = this.blocks.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.tops[middle + 1]! > y) high = middle; else low = middle + 1;
    }
    return low;
  }

  private draw(spare = 1): void {
    const { scrollTop, scrollLeft, clientHeight, clientWidth } = this.box, more = spare * clientHeight / 2;
    const view = this.isWhole ? { top: 0, bottom: Infinity, left: 0, right: Infinity, spare }
      : { top: scrollTop - more, bottom: scrollTop + clientHeight + more, left: scrollLeft, right: scrollLeft + clientWidth, spare };
    const first = this.blockAt(view.top), last = Math.min(this.blocks.length, this.blockAt(view.bottom) + 1);
    this.live.keep(first, last, (index) => {
      const element = this.blocks[index]!.make();
      element.style.top = `${this.tops[index]}px`;
      element.style.height = `${this.blocks[index]!.height}px`;
      element.style.width = `${this.blocks[index]!.width}px`;
      return element;
    });
    for (let i = first; i < last; ++i) {
      const top = this.tops[i]!;
      this.blocks[i]!.draw({ ...view, top: view.top - top, bottom: view.bottom - top });
    }
  }
}
