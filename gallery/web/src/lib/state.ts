// The state of a page in the URL's hash, so that a link shows the same: #a=lobelia&b=povray&mode=slide.
// A hash without '=' is an anchor of the page and left alone.

/** What is shown where one file holds several pages: of a report in one file (single_file.ts), or cells (views/packed.ts). */
export const kPlaces: readonly string[] = ['page', 'cell'];

export class HashState<Key extends string> {
  private values = new Map<string, string>();
  private place: [string, string][] = [];
  private readonly listeners: (() => void)[] = [];

  /** Values at their default are left out of the link. */
  constructor(readonly defaults: Readonly<Record<Key, string>>) {
    this.read();
    addEventListener('hashchange', () => {
      if (!this.read()) return;
      for (const listener of this.listeners) listener();
    });
  }

  get(key: Key): string { return this.values.get(key) ?? this.defaults[key]; }

  number(key: Key): number {
    const value = Number(this.get(key));
    return Number.isFinite(value) ? value : Number(this.defaults[key]);
  }

  /** Replaces the address, so that the back button leads to the page before and not through every drag. */
  set(changes: Partial<Record<Key, string>>): void {
    for (const [key, value] of Object.entries(changes) as [Key, string][]) {
      if (value === this.defaults[key]) this.values.delete(key);
      else this.values.set(key, value);
    }
    const query = new URLSearchParams([...this.place, ...this.values]).toString();
    if (query === '' && !location.hash.includes('=')) return;
    history.replaceState(history.state, '', query === '' ? '#top' : '#' + query);
  }

  /** Called when a link or the back button changed the hash. */
  onChange(listener: () => void): void { this.listeners.push(listener); }

  private read(): boolean {
    const text = location.hash.slice(1);
    if (text !== '' && !text.includes('=')) return false;
    this.values = new Map();
    this.place = [...new URLSearchParams(text)].filter(([key]) => kPlaces.includes(key));
    for (const [key, value] of new URLSearchParams(text))
      if (Object.hasOwn(this.defaults, key)) this.values.set(key, value);
    return true;
  }
}
