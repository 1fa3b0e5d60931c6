// The search for mistakes, which is studies/shader_check/web/search.cpp in WebAssembly.
import { inflated } from '../lib/inflate';

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  lobelia_text(bytes: number): number;
  lobelia_begin(exponent: number): number;
  lobelia_points(): number;
  lobelia_floats(): number;
  lobelia_texels(): number;
  lobelia_function(): number;
  lobelia_program(): number;
  lobelia_first_line(): number;
  lobelia_values(): number;
  lobelia_judge(): number;
  lobelia_vectors(count: number): number;
  lobelia_take(): number;
  lobelia_reason(): number;
}

export const kLanguages = ['glsl', 'wgsl'] as const;
export type Language = (typeof kLanguages)[number];

export interface Asked {
  readonly model: string; readonly lobe: string; readonly normalisation: string; readonly exponent: number;
  readonly language: Language; readonly text: string; readonly functionName: string; readonly argumentList: string; readonly settings: string;
}

/** A program to run for each point. It gives four floats: red, green, blue, and 1 where something is written. */
export interface Job {
  readonly program: string;
  /** Lines of it before the shader, and of the shader. */
  readonly firstLine: number; readonly lines: number;
  readonly count: number;
  /** All points, in texels of four floats, to a whole row of 1024. */
  readonly points: Float32Array<ArrayBuffer>;
}

export interface ErrorAt { readonly exponent: number; readonly ofPeak: number; readonly allowed: number; readonly value: number; readonly expected: number }
export interface Findings {
  readonly passes: boolean; readonly sentence: string; readonly mistakes: readonly string[];
  readonly nonfinite: number; readonly unwritten: number; readonly coloured: number; readonly calls: number;
  readonly errors: readonly ErrorAt[];
}

export class Search {
  private exports!: Exports;

  private constructor(private readonly module: WebAssembly.Module) { this.start(); }

  static async from(packed: string): Promise<Search> { return new Search(await WebAssembly.compile(await inflated(packed))); }

  functionName = '';
  private lines = 0;

  /** Makes the shader's program for the points of a check. Throws the reason in a sentence. */
  begin(asked: Asked): Job {
    return this.attempt((e) => {
      const { model, lobe, normalisation, language, functionName, argumentList, settings, text } = asked;
      const line = (words: string): string => words.replaceAll('\n', ' ').trim();
      const bytes = new TextEncoder().encode([model, lobe, normalisation, language, line(functionName), line(argumentList), line(settings).replaceAll(/\s/g, ''), text].join('\n'));
      const place = e.lobelia_text(bytes.length);
      new Uint8Array(e.memory.buffer, place, bytes.length).set(bytes);
      this.lines = text.split('\n').length;
      const count = e.lobelia_begin(asked.exponent);
      this.functionName = this.textAt(e.lobelia_function());
      return this.job(count);
    });
  }

  judge(values: Float32Array): Findings {
    return this.attempt((e) => {
      new Float32Array(e.memory.buffer, e.lobelia_values(), values.length).set(values);
      const [verdict, sentence, mistakes, , , odd, ...rows] = this.textAt(e.lobelia_judge()).split('\n');
      const numbers = (line = ''): number[] => line.split(' ').map(Number);
      const [calls = 0, nan = 0, infinite = 0, , , unwritten = 0, coloured = 0] = numbers(odd);
      return {
        passes: verdict === 'passes', sentence: sentence ?? '', mistakes: mistakes ? mistakes.split(' ') : [],
        calls, nonfinite: nan + infinite, unwritten, coloured,
        errors: rows.filter(Boolean).map(numbers).map(([exponent = 0, ofPeak = 0, allowed = 0, , , , value = 0, expected = 0]) =>
          ({ exponent, ofPeak, allowed, value, expected })),
      };
    });
  }

  /** The program of begin() for other points: normal, to the eye, to the light and the exponent, ten numbers each. */
  along(vectors: Float64Array): Job {
    return this.attempt((e) => {
      const place = e.lobelia_vectors(vectors.length / 10);
      new Float64Array(e.memory.buffer, place, vectors.length).set(vectors);
      return this.job(e.lobelia_take());
    });
  }

  private job(count: number): Job {
    const e = this.exports;
    return {
      count, program: this.textAt(e.lobelia_program()), firstLine: e.lobelia_first_line(), lines: this.lines,
      points: new Float32Array(e.memory.buffer, e.lobelia_points(), e.lobelia_floats()).slice(),
    };
  }

  private start(): void {
    const imports: WebAssembly.Imports = {};
    for (const { module, name } of WebAssembly.Module.imports(this.module))
      (imports[module] ??= {})[name] = () => {
        if (name === 'clock_time_get') return 0;  // a limit on time begins, and is not used
        throw new Error(`the search called ${name}`);
      };
    this.exports = new WebAssembly.Instance(this.module, imports).exports as unknown as Exports;
    this.exports._initialize();
  }

  /** What throws ends in a trap, after which only a new instance is of use. */
  private attempt<T>(act: (e: Exports) => T): T {
    try {
      return act(this.exports);
    } catch (error) {
      const reason = this.textAt(this.exports.lobelia_reason());
      this.start();
      throw new Error(reason || (error instanceof Error ? error.message : 'the search failed'));
    }
  }

  private textAt(place: number): string {
    const bytes = new Uint8Array(this.exports.memory.buffer, place);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }
}
