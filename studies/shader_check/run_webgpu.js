// In a page of Chromium: runs compute shaders and says on the console what they give, for studies/shader_check/run_webgpu.cpp.
// `job` is {token, points: base64 of float32s, invocations, groups: [x, y], rounds, programs: [base64 of WGSL]}. The token
// begins each line: what Chromium itself says stands on the console too, and may quote the shader.
const say = (...words) => console.log([job.token, ...words].join(' '));
const text64 = (text) => btoa(String.fromCharCode(...new TextEncoder().encode(text)));
// A loop, because Uint8Array.from takes a second for ten million bytes.
function bytes64(text) {
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
const kChunk = 6000;

async function run(job) {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) return say('none');
  const { vendor, architecture, device: name, description } = adapter.info;
  say('device', text64([vendor, architecture, name, description].filter(Boolean).join(' ')));
  const device = await adapter.requestDevice();
  const points = bytes64(job.points), size = 16 * job.invocations;
  const { STORAGE, COPY_SRC, COPY_DST, MAP_READ } = GPUBufferUsage;
  const input = device.createBuffer({ size: points.length, usage: STORAGE | COPY_DST });
  const output = device.createBuffer({ size, usage: STORAGE | COPY_SRC | COPY_DST });
  const copy = device.createBuffer({ size, usage: MAP_READ | COPY_DST });
  device.queue.writeBuffer(input, 0, points);

  const pipelines = [];
  for (const [k, program] of job.programs.entries()) {
    const module = device.createShaderModule({ code: new TextDecoder().decode(bytes64(program)) });
    const { messages } = await module.getCompilationInfo();
    const error = messages.find((message) => message.type === 'error');
    if (error) return say('refused', k, text64(`ERROR: ${error.lineNum}: ${error.message.split('\n')[0]}`));
    pipelines.push(await device.createComputePipelineAsync({ layout: 'auto', compute: { module, entryPoint: 'lobelia_main' } }));
  }
  const dispatch = async (pipeline) => {
    const entries = [input, output].map((buffer, binding) => ({ binding, resource: { buffer } }));
    const encoder = device.createCommandEncoder();
    encoder.clearBuffer(output);
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
    pass.dispatchWorkgroups(...job.groups);
    pass.end();
    encoder.copyBufferToBuffer(output, 0, copy, 0, size);
    device.queue.submit([encoder.finish()]);
    await copy.mapAsync(GPUMapMode.READ);
  };
  for (const [k, pipeline] of pipelines.entries()) {
    await dispatch(pipeline);
    const bytes = new Uint8Array(copy.getMappedRange());
    for (let at = 0; at < size; at += kChunk) say('values', k, btoa(String.fromCharCode(...bytes.subarray(at, at + kChunk))));
    copy.unmap();
  }
  for (let round = 0; round < job.rounds; ++round)
    for (const [k, pipeline] of pipelines.entries()) {
      const begun = performance.now();
      await dispatch(pipeline);
      say('seconds', k, (performance.now() - begun) / 1000);
      copy.unmap();
    }
}
run(job).catch((error) => say('broken', text64(error.message))).finally(() => say('done'));
