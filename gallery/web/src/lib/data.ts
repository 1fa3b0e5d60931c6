// Data in classic scripts, because a page on file:// may load nothing else: each calls
// lobelia("name",'JSON'), and JSON.parse keeps a hostile record from being anything but data.
import { inlined, type InlinedData } from './single_file';

const received = new Map<string, unknown>();

declare global {
  interface Window { lobelia: (name: string, json: string) => void }
}

window.lobelia = (name, json) => { received.set(name, JSON.parse(json)); };

/** The data from the script in the page's head, if there is one. */
export function pageData<T>(): T | undefined { return received.get('page') as T | undefined; }

/** Data of a script that this file holds, under its name. */
export function receive({ name, data }: InlinedData): void { received.set(name, data); }

/** Loads the script `source` (relative to the page) and returns its data called `name`. For each script once. */
export function load<T>(name: string, source: string): Promise<T> {
  const here = inlined(source);
  if (here) return here.name === name ? Promise.resolve(here.data as T) : Promise.reject(new Error(source + ' holds no "' + name + '"'));
  return new Promise((resolve, reject) => {
    const script = document.createElement('script');
    script.src = source;
    script.addEventListener('load', () => {
      if (received.has(name)) resolve(received.get(name) as T);
      else reject(new Error(source + ' holds no "' + name + '"'));
      received.delete(name);  // the caller has it; frees megabytes
      script.remove();
    });
    script.addEventListener('error', () => reject(new Error(source + ' cannot be read')));
    document.head.append(script);
  });
}
