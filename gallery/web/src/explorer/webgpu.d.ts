// The parts of WebGPU that gpu_runner.ts uses; TypeScript's DOM has none yet.
interface GPUBuffer { mapAsync(mode: number): Promise<void>; getMappedRange(): ArrayBuffer; destroy(): void }
interface GPUShaderModule { getCompilationInfo(): Promise<{ messages: readonly { type: string; message: string; lineNum: number }[] }> }
interface GPUPipeline { getBindGroupLayout(index: number): object }
interface GPUPass {
  setPipeline(pipeline: GPUPipeline): void; setBindGroup(index: number, group: object): void;
  dispatchWorkgroups(x: number, y: number): void; end(): void;
}
interface GPUEncoder {
  beginComputePass(): GPUPass; finish(): object;
  copyBufferToBuffer(from: GPUBuffer, at: number, to: GPUBuffer, toAt: number, size: number): void;
}
interface GPUDevice {
  readonly lost: Promise<unknown>;
  readonly queue: { writeBuffer(buffer: GPUBuffer, at: number, data: Float32Array<ArrayBuffer>): void; submit(work: object[]): void };
  createBuffer(about: { size: number; usage: number }): GPUBuffer;
  createShaderModule(about: { code: string }): GPUShaderModule;
  createComputePipelineAsync(about: { layout: 'auto'; compute: { module: GPUShaderModule; entryPoint: string } }): Promise<GPUPipeline>;
  createBindGroup(about: { layout: object; entries: { binding: number; resource: { buffer: GPUBuffer } }[] }): object;
  createCommandEncoder(): GPUEncoder;
  destroy(): void;
}
interface Navigator { readonly gpu?: { requestAdapter(): Promise<{ requestDevice(): Promise<GPUDevice> } | null> } }
declare const GPUBufferUsage: Readonly<Record<'STORAGE' | 'COPY_SRC' | 'COPY_DST' | 'MAP_READ', number>>;
declare const GPUMapMode: Readonly<Record<'READ', number>>;
