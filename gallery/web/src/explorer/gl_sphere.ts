// Paints the sphere with WebGL 2: exactly the text that `lobelia export` writes, in float32.
import { cameraOf, kDistance, type Surface, type Vector } from './sphere';

const kMostPrograms = 40;
const kHead = '#version 300 es\nprecision highp float;\nprecision highp int;\n';

/** Computes the coefficients: by the function of the text, or by four points of Gauss and Legendre in each of 64 parts of ln(1 + n s). */
function vertexText(surfaces: readonly Surface[]): string {
  const one = ({ shader }: Surface, i: number): string => {
    const { name, lobe } = namesIn(shader);
    return `float coefficient${i}() {
  float n = exponents[${i}];
  ${shader.includes(`float ${name}_coefficient(float n)`) ? `return ${name}_coefficient(n);` : `vec4 w = weights[${i}];
  float most = log(1.0 + n * ends[${i}]), sum = 0.0;
  for (int part = 0; part < 64; ++part) {
    float here = 0.0;
    for (int k = 0; k < 4; ++k) {
      float u = most * (float(part) + places[k]) / 64.0, s = (exp(u) - 1.0) / n;
      here += shares[k] * exp(u) * ${lobe}(s, n) * (w.x + s * (w.y + s * (w.z + s * w.w)));
    }
    sum += here;
  }
  return 64.0 * n / (most * sum);`}
}
`;
  };
  return `${kHead}${surfaces.map((s) => s.shader).join('\n')}
uniform vec2 exponents, ends;
uniform vec4 weights[2];
const vec4 places = vec4(0.0694318442, 0.3300094782, 0.6699905218, 0.9305681558);
const vec4 shares = vec4(0.1739274226, 0.3260725774, 0.3260725774, 0.1739274226);
flat out vec2 coefficients;
${surfaces.map(one).join('')}
void main() {
  coefficients = vec2(${surfaces.map((_, i) => `coefficient${i}()`).join(', ')}${surfaces.length > 1 ? '' : ', 0.0'});
  gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}`;
}

/** Integers count the pixels, so that no digit of the normal is lost at the rim. */
function fragmentText(surfaces: readonly Surface[]): string {
  const one = ({ shader }: Surface, i: number): string =>
    `${namesIn(shader).name}(normal, to_eye, light, exponents[${i}], coefficients[${i}])`;
  return `${kHead}${surfaces.map((s) => s.shader).join('\n')}
uniform vec2 exponents;
uniform vec3 light;
uniform float scale, rest;
uniform int size, edge;
flat in vec2 coefficients;
out vec4 radiance;
void main() {
  ivec2 odd = 2 * ivec2(gl_FragCoord.xy) + 1 - size;
  int squares = odd.x * odd.x + odd.y * odd.y;
  float inside = float(edge - squares) + rest, q = scale * scale * float(squares), d = ${kDistance.toFixed(1)};
  if (inside < 0.0) { radiance = vec4(0.0); return; }
  vec2 at = scale * vec2(odd);
  float z = (d * q + scale * sqrt((d * d - 1.0) * inside)) / (1.0 + q);
  vec3 normal = vec3((d - z) * at, z), to_eye = vec3(-at, 1.0) / sqrt(1.0 + q);
  radiance = vec4(${surfaces.map(one).join(', ')}, ${surfaces.length > 1 ? '' : '0.0, '}0.0, 1.0);
}`;
}

function namesIn(shader: string): { name: string; lobe: string } {
  const name = /\bfloat (\w+)\(vec3 \w+, vec3 to_eye, vec3 to_light,\s+float exponent, float coefficient\)/.exec(shader)?.[1];
  const lobe = /\bfloat (\w+_lobe)\(float s, float n\)/.exec(shader)?.[1];
  if (!name || !lobe) throw new Error('the record has no shader');
  return { name, lobe };
}

export class GlSphere {
  private readonly gl: WebGL2RenderingContext;
  private readonly programs = new Map<string, WebGLProgram>();
  private size = 0;

  /** Throws without WebGL 2 and its float pictures. */
  constructor() {
    const gl = document.createElement('canvas').getContext('webgl2');
    if (!gl?.getExtension('EXT_color_buffer_float')) throw new Error('no WebGL 2 with float pictures');
    this.gl = gl;
    gl.bindVertexArray(gl.createVertexArray());
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.bindRenderbuffer(gl.RENDERBUFFER, gl.createRenderbuffer());
  }

  /** Red is the radiance of the first surface, green the second's, alpha 1 on the sphere. The bottom row is first. */
  paint(size: number, toLight: Vector, surfaces: readonly Surface[]): Float32Array {
    const gl = this.gl, program = this.programOf(surfaces), { scale, edge } = cameraOf(size), [first, second] = surfaces;
    const place = (name: string): WebGLUniformLocation | null => gl.getUniformLocation(program, name);
    if (size !== this.size) {
      this.size = size;
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA32F, size, size);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, gl.getParameter(gl.RENDERBUFFER_BINDING));
      gl.viewport(0, 0, size, size);
    }
    gl.useProgram(program);
    gl.uniform2f(place('exponents'), first!.n, second?.n ?? 1);
    gl.uniform2f(place('ends'), first!.model.sMax, second?.model.sMax ?? 1);
    gl.uniform4fv(place('weights'), surfaces.flatMap((s) => s.model.weights));
    gl.uniform3f(place('light'), ...toLight);
    gl.uniform1f(place('scale'), scale);
    gl.uniform1i(place('size'), size);
    gl.uniform1i(place('edge'), Math.floor(edge));
    gl.uniform1f(place('rest'), edge % 1);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const pixels = new Float32Array(4 * size * size);
    gl.readPixels(0, 0, size, size, gl.RGBA, gl.FLOAT, pixels);
    if (gl.getError() !== gl.NO_ERROR || gl.isContextLost()) throw new Error('WebGL 2 does not read float pictures');
    return pixels;
  }

  private programOf(surfaces: readonly Surface[]): WebGLProgram {
    const key = surfaces.map((s) => s.shader).join('\n'), known = this.programs.get(key);
    if (known) return known;
    const gl = this.gl, program = gl.createProgram();
    if (this.programs.size > kMostPrograms) {
      for (const old of this.programs.values()) gl.deleteProgram(old);
      this.programs.clear();
    }
    for (const [type, text] of [[gl.VERTEX_SHADER, vertexText(surfaces)], [gl.FRAGMENT_SHADER, fragmentText(surfaces)]] as const) {
      const shader = gl.createShader(type)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader) ?? 'the shader does not compile');
      gl.attachShader(program, shader);
      gl.deleteShader(shader);  // when the program goes
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) ?? 'the shader does not link');
    this.programs.set(key, program);
    return program;
  }
}
