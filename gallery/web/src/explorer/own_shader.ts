// A shader that the reader pastes: it runs beside the highlight A, on the sphere and for the search for mistakes.
import { announce, button, h, select } from '../lib/dom';
import { numberText } from '../lib/numbers';
import type { HashState } from '../lib/state';
import { makeRunner, type Runner, Stuck } from './runner';
import { type Findings, type Job, kLanguages, type Language, Search } from './search';
import { packed, unpacked } from './shader_link';
import { cameraOf, kDistance, type Vector } from './sphere';

export const kOwnState = { own: '', lang: 'glsl', fn: '', args: '', set: '' };
type Key = keyof typeof kOwnState;

const kMostLetters = 20_000;
const kExamples: Record<Language, string> = {
  glsl: `float highlight(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 R = reflect(-V, N);
    return (n + 2.0) / 2.0 * pow(max(dot(R, L), 0.0), n) * max(dot(N, L), 0.0);
}
`,
  wgsl: `fn highlight(N: vec3f, V: vec3f, L: vec3f, n: f32) -> f32
{
    let R = reflect(-V, N);
    return (n + 2.0) / 2.0 * pow(max(dot(R, L), 0.0), n) * max(dot(N, L), 0.0);
}
`,
};

/** The highlight beside which the shader runs. */
export interface Beside { readonly model: string; readonly lobe: string; readonly normalisation: string; readonly exponent: number; readonly title: string }

export class OwnShader {
  private readonly text = h('textarea', { id: 'own-text', rows: 9, spellcheck: 'false', autocapitalize: 'off', autocomplete: 'off', maxlength: kMostLetters, wrap: 'off' });
  private readonly functionName = h('input', { id: 'own-function', type: 'text', size: 12, maxlength: 100, placeholder: 'found' });
  private readonly argumentList = h('input', { id: 'own-arguments', type: 'text', size: 12, maxlength: 300, placeholder: 'found' });
  private readonly settings = h('input', { id: 'own-settings', type: 'text', size: 24, maxlength: 1000, placeholder: 'uShininess=n; uColor=1,1,1' });
  private readonly language;
  private readonly run = button('Run', () => this.start());
  private readonly stop = button('Show B again', () => this.end());
  private readonly link = button('Copy link', () => { void this.copyLink(); });
  private readonly status = h('p', { class: 'own-status', role: 'status' });
  private readonly result = h('div', { class: 'own-result' });
  private readonly runners = new Map<Language, Runner>();
  private search: Search | undefined;
  private queue: Promise<unknown> = Promise.resolve();
  private asked = '';
  private turn = 0;  // of the check that is wanted
  private vectors: { key: string; values: Float64Array } | undefined;
  /** Whether the sphere shows it. */
  isShown = false;
  /** It does not end, and nothing else is drawn. */
  isStuck = false;
  readonly element: HTMLDetailsElement;

  /** `search` is the packed WebAssembly, '' if this gallery has none. `changed` draws the page anew. */
  constructor(private readonly state: HashState<Key>, private readonly packedSearch: string, private readonly beside: () => Beside | undefined,
              private readonly changed: () => void) {
    this.language = select('Language', [{ value: 'glsl', label: 'GLSL (WebGL 2)' }, { value: 'wgsl', label: 'WGSL (WebGPU)' }], 'glsl', (lang) => {
      this.state.set({ lang });
      this.showExample();
      this.edited();
    }, 'own-language');
    this.text.value = kExamples.glsl;
    for (const field of [this.text, this.functionName, this.argumentList, this.settings]) field.addEventListener('change', () => this.edited());
    this.text.addEventListener('input', () => { if (state.get('own')) this.edited(); });
    this.text.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' || !(event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      this.start();
    });
    this.stop.hidden = true;
    this.element = h('details', { class: 'choice choice-own', open: state.get('own') !== '' }, h('summary', {}, 'Your shader, beside A'),
      ...(packedSearch ? this.form() : [h('p', {}, 'This Lobelia was built without the search for mistakes: type “tools/setup wasm” in its source, build it again, and write the gallery anew.')]));
    if (packedSearch) void this.take();
    state.onChange(() => { this.end(); void this.take(); });
  }

  private form(): Node[] {
    const label = (words: string, field: HTMLElement): HTMLElement => h('label', {}, h('span', {}, words), field);
    return [
      h('p', { class: 'own-lead' }, 'Paste a function that returns the radiance of a highlight. It runs on your graphics processor, and nothing leaves the page.'),
      h('div', { class: 'own-sides' },
        h('div', {}, h('label', { class: 'unseen', for: 'own-text' }, 'Your shader'), this.text,
          h('div', { class: 'choice-body' }, this.language.element, label('Function', this.functionName), label('Arguments', this.argumentList), label('Values (--set)', this.settings)),
          h('div', { class: 'controls' }, this.run, this.stop, this.link)),
        h('div', {}, this.status, this.result)),
    ];
  }

  /** In the chosen language, if the reader has written nothing. */
  private showExample(): void {
    if (Object.values(kExamples).includes(this.text.value)) this.text.value = kExamples[this.chosenLanguage()];
  }

  private chosenLanguage(): Language { return kLanguages.find((language) => language === this.state.get('lang')) ?? 'glsl'; }

  /** From the link. It is text, and runs when the reader says so. */
  private async take(): Promise<void> {
    const words = this.state.get('own'), language = this.chosenLanguage();
    this.language.set(language);
    this.showExample();
    this.functionName.value = this.state.get('fn').slice(0, 100);
    this.argumentList.value = this.state.get('args').slice(0, 300);
    this.settings.value = this.state.get('set').slice(0, 1000);
    if (!words) return;
    this.element.open = true;
    const text = await unpacked(words);
    if (text !== undefined) this.text.value = text.slice(0, kMostLetters);
    this.say(text === undefined ? 'The link holds no shader that can be read.' : 'This shader came with the link. Read it before you press Run.');
  }

  private edited(): void {
    this.state.set({ own: '', fn: this.functionName.value, args: this.argumentList.value, set: this.settings.value });
    if (this.isShown) this.say('Changed. Press Run to see the new one.');
  }

  private async copyLink(): Promise<void> {
    try {
      this.state.set({ own: await packed(this.text.value) });
      await navigator.clipboard.writeText(location.href);
      this.say('The link is copied. The shader is in its fragment, which browsers do not send.');
    } catch (error) {
      this.say(error instanceof Error && error.message === 'too long' ? 'The shader is too long for a link.' : 'The link is in the address bar; this browser does not let the page copy it.');
    }
  }

  private say(words: string): void { this.status.textContent = words; }

  private end(): void {
    if (!this.isShown || this.isStuck) return;
    this.isShown = false;
    this.stop.hidden = true;
    this.asked = '';
    ++this.turn;
    this.result.replaceChildren();
    this.say('');
    this.changed();
  }

  private start(): void {
    this.asked = '';
    this.isShown = true;
    this.result.replaceChildren();
    this.changed();
  }

  /** Runs the check again if the shader or the highlight A is another one. */
  refresh(): void {
    if (!this.isShown) return;
    const beside = this.beside();
    if (!beside) return;
    const language = this.chosenLanguage();
    const asked = { ...beside, language, text: this.text.value, functionName: this.functionName.value, argumentList: this.argumentList.value, settings: this.settings.value };
    // Text that is being typed waits for Run.
    const key = JSON.stringify([beside.model, beside.lobe, beside.normalisation, beside.exponent]);
    if (key === this.asked) return;
    this.asked = key;
    const turn = ++this.turn;
    this.say('It runs …');
    this.run.disabled = true;
    this.one(async () => {
      if (turn !== this.turn) return;
      try {
        this.search ??= await Search.from(this.packedSearch);
        const values = await this.runner(language).run(this.search.begin(asked));
        if (turn !== this.turn) return;
        this.show(this.search.judge(values), beside, this.search.functionName);
        this.stop.hidden = false;
        this.changed();
      } catch (error) {
        await this.fail(error);
      }
    });
  }

  private runner(language: Language): Runner {
    let runner = this.runners.get(language);
    if (!runner) this.runners.set(language, runner = makeRunner(language));
    return runner;
  }

  /** One after the other, because they share the search's memory. */
  private one<T>(act: () => Promise<T>): Promise<T> {
    const result = this.queue.then(act).finally(() => { this.run.disabled = false; });
    this.queue = result.catch(() => {});
    return result;
  }

  private async fail(error: unknown): Promise<void> {
    this.result.replaceChildren();
    this.say(error instanceof Error ? error.message : String(error));
    if (error instanceof Stuck) {
      this.isStuck = true;
      await error.ended;
      this.isStuck = false;
      this.say('The shader did not end within 10 seconds. It has ended now.');
    }
    this.isShown = false;
    this.stop.hidden = true;
    this.asked = '';
    this.changed();
  }

  /** The radiances on the sphere, by pixels from the bottom row; NaN beside it. Undefined if it does not run. */
  sphere(size: number, toLight: Vector): Promise<Float32Array | undefined> {
    return this.one(async () => {
      const beside = this.beside();
      if (!this.isShown || !this.search || !beside || this.result.childElementCount === 0) return undefined;
      try {
        const { places, vectors } = this.spherePoints(size, toLight, beside.exponent);
        const job: Job = this.search.along(vectors);
        const values = await this.runner(this.chosenLanguage()).run(job), shown = new Float32Array(size * size).fill(NaN);
        places.forEach((place, i) => { shown[place] = values[4 * i]!; });
        return shown;
      } catch (error) {
        await this.fail(error);
        return undefined;
      }
    });
  }

  private places: number[] = [];

  private spherePoints(size: number, light: Vector, exponent: number): { places: number[]; vectors: Float64Array } {
    const key = String(size);
    if (this.vectors?.key !== key) {
      const { scale, edge } = cameraOf(size), values: number[] = [], d = kDistance;
      this.places = [];
      for (let y = 0; y < size; ++y) for (let x = 0; x < size; ++x) {
        const at = [scale * (2 * x + 1 - size), scale * (2 * y + 1 - size)] as const, q = at[0] ** 2 + at[1] ** 2, inside = edge - q / scale ** 2;
        if (inside < 0) continue;
        const z = (d * q + scale * Math.sqrt((d * d - 1) * inside)) / (1 + q), far = Math.sqrt(1 + q);
        this.places.push(y * size + x);
        values.push((d - z) * at[0], (d - z) * at[1], z, -at[0] / far, -at[1] / far, 1 / far, 0, 0, 0, 0);
      }
      this.vectors = { key, values: Float64Array.from(values) };
    }
    const { values } = this.vectors;
    for (let i = 6; i < values.length; i += 10) {
      values.set(light, i);
      values[i + 3] = exponent;
    }
    return { places: this.places, vectors: values };
  }

  private show(found: Findings, beside: Beside, functionName: string): void {
    const odd = [[found.nonfinite, 'are no finite number'], [found.unwritten, 'have no result'], [found.coloured, 'have a colour; its red is compared']] as const;
    const percent = (share: number): string => `${numberText(100 * share, 3)} %`;
    this.say('');
    this.result.replaceChildren(
      h('p', { class: 'own-verdict', 'data-verdict': found.passes ? 'passes' : 'differs' },
        h('strong', {}, found.passes ? 'Passes: ' : 'Differs: '),
        found.passes ? `${functionName} is the model within the rounding of float32.` : `${functionName}: ${found.sentence}.`),
      h('p', {}, found.mistakes.length ? 'Mistakes: ' : '', ...found.mistakes.map((mistake) => h('code', {}, mistake)),
        h('span', { class: 'own-beside' }, ` Compared with ${beside.title}.`)),
      ...odd.filter(([count]) => count > 0).map(([count, words]) => h('p', {}, `${count} of ${found.calls} calls ${words}.`)),
      h('div', { class: 'table-wrap', tabindex: 0, role: 'region', 'aria-label': 'The largest errors' },
        h('table', { class: 'figures' },
          h('caption', {}, 'The largest error at each exponent, of the model’s peak'),
          h('thead', {}, h('tr', {}, ...['n', 'error', 'allowed', 'yours there', 'the model'].map((title) => h('th', { scope: 'col' }, title)))),
          h('tbody', {}, ...found.errors.map((e) => h('tr', {}, h('th', { scope: 'row' }, numberText(e.exponent, 5)),
            ...[percent(e.ofPeak), percent(e.allowed), numberText(e.value, 4), numberText(e.expected, 4)].map((text) => h('td', { class: 'number' }, text))))))));
    announce(found.passes ? 'The shader passes.' : `The shader differs: ${found.sentence}.`);
  }
}
