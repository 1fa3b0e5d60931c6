// Runs a reader's shader on WebGL 2 or WebGPU, in small parts, and gives up after some seconds.
import { GlRunner } from './gl_runner';
import { GpuRunner } from './gpu_runner';
import type { Job, Language } from './search';

export interface Runner { run(job: Job): Promise<Float32Array> }

export const kMostMilliseconds = 10_000;
export const pause = (milliseconds: number): Promise<void> => new Promise((done) => { setTimeout(done, milliseconds); });

/** A shader takes too long. Until `ended` the graphics processor does nothing else, and a page that asks for it stands still. */
export class Stuck extends Error {
  constructor(readonly ended: Promise<unknown>) { super('The shader did not end within 10 seconds. The sphere stands still until the browser has ended it.'); }
}
export const lost = (api: string): Error => new Error(`The browser ended the shader and took ${api} from the page, as it does with one that does not end. Run starts it anew.`);

/** "line 3: ..." of a compiler's first message, which is about line `at` of the program. */
export function atLine(at: number, { firstLine, lines }: Job, words: string): string {
  const line = at - firstLine, text = words.slice(0, 300);
  return line >= 1 && line <= lines ? `line ${line}: ${text}` : `the call of the function does not compile: ${text}`;
}

export function makeRunner(language: Language): Runner { return language === 'wgsl' ? new GpuRunner() : new GlRunner(); }
