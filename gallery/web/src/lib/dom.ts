// Building a page from data. Text goes in as text nodes and attributes by setAttribute: nothing from a
// record is ever parsed as markup, and the pages' policy would refuse to run it.

type Value = string | number | boolean | undefined;
type Child = Node | string | undefined | null | false;

const kSvg = 'http://www.w3.org/2000/svg';

function fill(element: Element, attributes: Record<string, Value>, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    element.setAttribute(name, value === true ? '' : String(value));
  }
  for (const child of children) if (child) element.append(child);
}

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Record<string, Value> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K, attributes: Record<string, Value> = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  const element = document.createElementNS(kSvg, tag) as SVGElementTagNameMap[K];
  fill(element, attributes, children);
  return element;
}

export function button(label: string, act: () => void, attributes: Record<string, Value> = {}): HTMLButtonElement {
  const element = h('button', { type: 'button', ...attributes }, label);
  element.addEventListener('click', act);
  return element;
}

export interface Choice { readonly value: string; readonly label: string }

/** A labelled list; `set` shows another choice without calling back. */
export function select(label: string, choices: readonly Choice[], chosen: string,
                       act: (value: string) => void, id?: string):
    { element: HTMLLabelElement; set(value: string): void } {
  const list = h('select', { id }, ...choices.map((c) => h('option', { value: c.value }, c.label)));
  list.value = chosen;
  list.addEventListener('change', () => act(list.value));
  return { element: h('label', {}, h('span', {}, label), list), set: (value) => { list.value = value; } };
}

/** True while the reader types, when letters are no commands. */
export function isTyping(event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return true;
  const at = event.target;
  if (at instanceof HTMLInputElement) return at.type !== 'range' && at.type !== 'checkbox' && at.type !== 'radio';
  return at instanceof HTMLSelectElement || at instanceof HTMLTextAreaElement;
}

/** Tells screen readers something once. */
export function announce(words: string): void {
  let place = document.getElementById('announcer');
  if (!place) {
    place = h('div', { id: 'announcer', class: 'unseen', 'aria-live': 'polite' });
    (document.querySelector('main') ?? document.body).append(place);
  }
  place.textContent = words;
}
