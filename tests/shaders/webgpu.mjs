// Runs compute shaders in Chromium with WebGPU, on SwiftShader, which needs no graphics processor:
//     node webgpu.mjs POINTS CALLS COUNT SHADER...
// POINTS is a file of float32s, the shaders' binding 0. Each shader's `main`, of workgroups of 64, is called CALLS times or
// more; then COUNT float32s of binding 1 are written to SHADER.out. Exits with 77 if Chromium has no WebGPU, and with 1
// and what it says of a shader that it refuses.
import { readFileSync, writeFileSync } from 'node:fs';
import { launch } from '../../gallery/web/test/browser.mjs';

const [points, calls, count, ...shaders] = process.argv.slice(2);

/** In the page: for each shader the output in base64, or why it is refused. */
async function run({ points, calls, count, codes }) {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) return null;
  const device = await adapter.requestDevice();
  const bytes = Uint8Array.from(atob(points), (c) => c.charCodeAt(0)), size = 4 * count;
  const { STORAGE, COPY_SRC, COPY_DST, MAP_READ } = GPUBufferUsage;
  const input = device.createBuffer({ size: bytes.length, usage: STORAGE | COPY_DST });
  const output = device.createBuffer({ size, usage: STORAGE | COPY_SRC });
  const copy = device.createBuffer({ size, usage: MAP_READ | COPY_DST });
  device.queue.writeBuffer(input, 0, bytes);

  const compile = async (code) => {
    const module = device.createShaderModule({ code });
    const { messages } = await module.getCompilationInfo();
    if (messages.length) throw new Error(messages.map((m) => `line ${m.lineNum}: ${m.message}`).join('\n'));
    return device.createComputePipelineAsync({ layout: 'auto', compute: { module, entryPoint: 'main' } });
  };
  const evaluate = async (pipeline) => {
    const entries = [input, output].map((buffer, binding) => ({ binding, resource: { buffer } }));
    const encoder = device.createCommandEncoder(), pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
    pass.dispatchWorkgroups(Math.ceil(calls / 64));
    pass.end();
    encoder.copyBufferToBuffer(output, 0, copy, 0, size);
    device.queue.submit([encoder.finish()]);
    await copy.mapAsync(GPUMapMode.READ);
    const result = new Uint8Array(copy.getMappedRange());
    let text = '';
    for (let at = 0; at < size; at += 32768) text += String.fromCharCode(...result.subarray(at, at + 32768));
    copy.unmap();
    return btoa(text);
  };
  // Compiling takes most of the time, and goes on in several threads.
  const compiled = codes.map(compile), results = [];
  for (const pipeline of compiled)
    results.push(await pipeline.then(evaluate).then((values) => ({ values }), (error) => ({ refused: error.message })));
  return results;
}

const browser = await launch(['--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader']);
const page = await browser.newPage();
page.setDefaultTimeout(0);
// WebGPU is for secure pages only, which those of this machine are. Nothing is asked for.
await page.route('**', (route) => route.fulfill({ contentType: 'text/html', body: '<!doctype html>' }));
await page.goto('http://localhost/');
const results = await page.evaluate(run, {
  points: readFileSync(points).toString('base64'), calls: Number(calls), count: Number(count),
  codes: shaders.map((shader) => readFileSync(shader, 'utf8')),
});
await browser.close();
if (!results) process.exit(77);
results.forEach(({ refused, values }, i) => {
  if (values) return writeFileSync(shaders[i] + '.out', Buffer.from(values, 'base64'));
  console.error(`${shaders[i]}: ${refused}`);
  process.exitCode = 1;
});
