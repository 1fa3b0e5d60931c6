// Runs a fragment shader of WebGL 2 for each point. The values come back as bits, so that no extension is needed.
import { atLine, kMostMilliseconds, lost, pause, type Runner, Stuck } from './runner';
import type { Job } from './search';

const kWidth = 1024;  // of the textures, as in studies/shader_check/runner_protocol.hpp
const kRows = 32;  // of a part
const kMostPrograms = 8;
const kVertices = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`;

export class GlRunner implements Runner {
  private gl: WebGL2RenderingContext | undefined;
  private programs = new Map<string, WebGLProgram>();

  async run(job: Job): Promise<Float32Array> {
    const gl = this.context(), deadline = performance.now() + kMostMilliseconds;
    const rows = Math.ceil(job.count / kWidth), texelRows = job.points.length / (4 * kWidth);
    if (Math.max(rows, texelRows) > Number(gl.getParameter(gl.MAX_TEXTURE_SIZE))) throw new Error('This graphics processor has too small textures.');
    const program = await this.program(gl, job, deadline);
    gl.useProgram(program);
    gl.uniform1i(gl.getUniformLocation(program, 'lobelia_points'), 0);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, kWidth, texelRows, 0, gl.RGBA, gl.FLOAT, job.points);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA32UI, kWidth, rows);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, gl.getParameter(gl.RENDERBUFFER_BINDING));
    gl.viewport(0, 0, kWidth, rows);
    gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
    // A few points first: an endless loop shows there.
    await this.part(gl, [0, 0, 16, 1], deadline);
    for (let row = 0; row < rows; row += kRows) await this.part(gl, [0, row, kWidth, Math.min(kRows, rows - row)], deadline);
    const bits = new Uint32Array(4 * kWidth * rows);
    gl.readPixels(0, 0, kWidth, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, bits);
    this.requireContext(gl);
    if (gl.getError() !== gl.NO_ERROR) throw new Error('WebGL 2 does not read the values back.');
    return new Float32Array(bits.buffer, 0, 4 * job.count);
  }

  private context(): WebGL2RenderingContext {
    if (this.gl && !this.gl.isContextLost()) return this.gl;
    const gl = document.createElement('canvas').getContext('webgl2');
    if (!gl) throw new Error('This browser has no WebGL 2.');
    this.gl = gl;
    this.programs = new Map();
    gl.bindVertexArray(gl.createVertexArray());
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.bindRenderbuffer(gl.RENDERBUFFER, gl.createRenderbuffer());
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    gl.enable(gl.SCISSOR_TEST);
    return gl;
  }

  private requireContext(gl: WebGL2RenderingContext): void {
    if (!gl.isContextLost()) return;
    this.gl = undefined;
    throw lost('WebGL');
  }

  /** Asks again and again, because any other question would wait for the answer. */
  private async until(gl: WebGL2RenderingContext, isDone: () => boolean, deadline: number): Promise<void> {
    const waits = async (end: number): Promise<boolean> => {
      while (!gl.isContextLost() && !isDone()) {
        if (performance.now() > end) return false;
        await pause(4);
      }
      return true;
    };
    if (!await waits(deadline)) {
      this.gl = undefined;
      throw new Stuck(waits(Infinity));
    }
    this.requireContext(gl);
  }

  private async part(gl: WebGL2RenderingContext, box: readonly [number, number, number, number], deadline: number): Promise<void> {
    gl.scissor(...box);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    await this.until(gl, () => !fence || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED, deadline);
    gl.deleteSync(fence);
  }

  private async program(gl: WebGL2RenderingContext, job: Job, deadline: number): Promise<WebGLProgram> {
    const known = this.programs.get(job.program);
    if (known) return known;
    if (this.programs.size >= kMostPrograms) {
      for (const old of this.programs.values()) gl.deleteProgram(old);
      this.programs.clear();
    }
    const program = gl.createProgram(), shaders = ([[gl.VERTEX_SHADER, kVertices], [gl.FRAGMENT_SHADER, job.program]] as const).map(([type, text]) => {
      const shader = gl.createShader(type)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      gl.deleteShader(shader);
      return shader;
    });
    gl.linkProgram(program);
    const parallel = gl.getExtension('KHR_parallel_shader_compile');
    await this.until(gl, () => !parallel || Boolean(gl.getProgramParameter(program, parallel.COMPLETION_STATUS_KHR)), deadline);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      const log = gl.getShaderInfoLog(shaders[1]!) || gl.getProgramInfoLog(program) || 'no reason given';
      gl.deleteProgram(program);
      throw new Error(reasonIn(log, job));
    }
    this.programs.set(job.program, program);
    return program;
  }
}

/** ANGLE and others: "ERROR: 0:12: 'x' : undeclared identifier". */
function reasonIn(log: string, job: Job): string {
  for (const line of log.slice(0, 4000).split('\n')) {
    const found = /^ERROR: \d+:(\d+): (.*)$/.exec(line);
    if (found) return atLine(Number(found[1]), job, found[2]!);
  }
  return log.slice(0, 300);
}
