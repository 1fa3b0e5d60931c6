// Runs a compute shader of WGSL for each point.
import { atLine, kMostMilliseconds, lost, pause, type Runner, Stuck } from './runner';
import type { Job } from './search';

// As in studies/shader_check/runner_protocol.hpp.
const kGroup = 64, kGroupsInRow = 32768;

export class GpuRunner implements Runner {
  private device: GPUDevice | undefined;

  async run(job: Job): Promise<Float32Array> {
    const device = await this.made(), size = 16 * job.count;
    const work = this.dispatch(device, job, size), taken = device.lost.then(() => { this.device = undefined; throw lost('WebGPU'); });
    const first = Promise.race([work, taken]);
    const values = await Promise.race([first, pause(kMostMilliseconds).then(() => undefined)]);
    if (values) return values;
    this.device = undefined;
    throw new Stuck(first.catch(() => {}));
  }

  private async made(): Promise<GPUDevice> {
    if (this.device) return this.device;
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) throw new Error('This browser has no WebGPU here, so it runs no WGSL. “lobelia check-shader” does.');
    this.device = await adapter.requestDevice();
    return this.device;
  }

  private async dispatch(device: GPUDevice, job: Job, size: number): Promise<Float32Array> {
    const module = device.createShaderModule({ code: job.program }), { messages } = await module.getCompilationInfo();
    const error = messages.find((message) => message.type === 'error');
    if (error) throw new Error(atLine(error.lineNum, job, error.message.split('\n')[0] ?? ''));
    const pipeline = await device.createComputePipelineAsync({ layout: 'auto', compute: { module, entryPoint: 'lobelia_main' } });
    const buffers = [
      device.createBuffer({ size: job.points.byteLength, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST }),
      device.createBuffer({ size, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC }),
    ] as const, copy = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    device.queue.writeBuffer(buffers[0], 0, job.points);
    const encoder = device.createCommandEncoder(), pass = encoder.beginComputePass(), groups = Math.ceil(job.count / kGroup);
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries: buffers.map((buffer, binding) => ({ binding, resource: { buffer } })) }));
    pass.dispatchWorkgroups(Math.min(groups, kGroupsInRow), Math.ceil(groups / kGroupsInRow));
    pass.end();
    encoder.copyBufferToBuffer(buffers[1], 0, copy, 0, size);
    device.queue.submit([encoder.finish()]);
    await copy.mapAsync(GPUMapMode.READ);
    const values = new Float32Array(copy.getMappedRange().slice(0));
    for (const buffer of [...buffers, copy]) buffer.destroy();
    return values;
  }
}
