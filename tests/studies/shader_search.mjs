// node shader_search.mjs SEARCH.wasm {TEXT FILE}...: the words of the search for each file of points and values.
import { readFileSync } from 'node:fs';

const [wasm, ...jobs] = process.argv.slice(2), module = new WebAssembly.Module(readFileSync(wasm)), imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module))
  (imports[from] ??= {})[name] = () => {
    if (name !== 'clock_time_get') throw new Error(name);
    return 0;  // a limit on time begins, and is not used
  };
const { exports } = new WebAssembly.Instance(module, imports);
exports._initialize();

const memory = () => new Uint8Array(exports.memory.buffer);
const put = (place, bytes) => memory().set(bytes, place);
const text = (place) => new TextDecoder().decode(memory().subarray(place, memory().indexOf(0, place)));
try {
  for (let i = 0; i < jobs.length; i += 2) {
    const asked = new TextEncoder().encode(jobs[i]), bytes = readFileSync(jobs[i + 1]), count = bytes.length / (10 * 8 + 4 * 4);
    put(exports.lobelia_text(asked.length), asked);
    exports.lobelia_begin(64);
    put(exports.lobelia_vectors(count), bytes.subarray(0, count * 80));
    exports.lobelia_take();
    put(exports.lobelia_values(), bytes.subarray(count * 80));
    process.stdout.write(text(exports.lobelia_judge()));
  }
} catch (error) {
  console.error(error.message, text(exports.lobelia_reason()));
  process.exitCode = 1;
}
