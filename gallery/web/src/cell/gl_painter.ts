// Paints float pictures with WebGL 2, without filtering.
import { kColours, kStopCount, stopsOf } from './colours';
import type { FloatPicture } from './half_picture';
import type { Look, Painter, Pane } from './painter';

const kVertex = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`;

const kFragment = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D ours, first, second;
uniform bvec2 fromOurs;
uniform int what;  // 0 a picture; 1 absolute, 2 relative, 3 signed difference; 4 a map
uniform bool falseColour;
uniform float gain, top, decades, white;
uniform vec3 map[${kStopCount}];
uniform vec4 place;  // left, top of the pane in the canvas (y down); x, y of the picture there
uniform float zoom, canvasHeight;
uniform ivec2 size;
uniform int block;  // pixels of the cell to one of a map
out vec4 shown;

bool isBad(vec3 v) { return any(isnan(v)) || any(isinf(v)); }
vec3 encoded(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
vec3 ramp(float share) {
  float at = clamp(share, 0.0, 1.0) * ${(kStopCount - 1).toFixed(1)};
  int from = min(int(at), ${kStopCount - 2});
  return mix(map[from], map[from + 1], at - float(from));
}
vec3 coloured(float value) { return ramp(1.0 + log(max(value, 1e-37) / top) / (decades * log(10.0))); }
void main() {
  vec2 at = (vec2(gl_FragCoord.x, canvasHeight - gl_FragCoord.y) - place.xy) / zoom + place.zw;
  ivec2 pixel = ivec2(floor(at));
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) {
    shown = vec4(0.13, 0.13, 0.14, 1.0);
    return;
  }
  vec3 base = texelFetch(ours, pixel, 0).rgb, a = texelFetch(first, pixel / block, 0).rgb;
  if (what == 0) {
    vec3 value = fromOurs.x ? base + a : a;
    if (isBad(value)) shown = vec4(1.0, 0.0, 1.0, 1.0);
    else if (falseColour) shown = vec4(coloured(dot(value, vec3(1.0 / 3.0))), 1.0);
    else shown = vec4(encoded(value * gain), 1.0);
    return;
  }
  if (what == 4) {
    if (isBad(a)) shown = vec4(1.0, 0.0, 1.0, 1.0);
    else shown = vec4(falseColour ? coloured(a.r) : ramp(a.r / white), 1.0);
    return;
  }
  vec3 b = texelFetch(second, pixel, 0).rgb;
  // Subtracting two stored differences from ours keeps digits that the values have lost.
  vec3 d = fromOurs.x == fromOurs.y ? a - b : (fromOurs.x ? base + a : a) - (fromOurs.y ? base + b : b);
  if (isBad(d)) { shown = vec4(1.0, 0.0, 1.0, 1.0); return; }
  if (what == 2) {
    vec3 reference = abs(fromOurs.y ? base + b : b);
    d = mix(d / max(reference, 1e-37), vec3(0.0), equal(d, vec3(0.0)));
  }
  vec3 size3 = abs(d) / white;
  float largest = max(size3.r, max(size3.g, size3.b));
  if (what == 3) {
    float mean = (d.r + d.g + d.b) / 3.0 / white;
    float strength = sqrt(clamp(abs(mean), 0.0, 1.0));
    shown = vec4(mix(vec3(0.06), mean > 0.0 ? vec3(1.0, 0.45, 0.2) : vec3(0.3, 0.65, 1.0), strength), 1.0);
  } else if (falseColour) {
    shown = vec4(coloured(largest * top), 1.0);
  } else {
    shown = vec4(clamp(size3, 0.0, 1.0), 1.0);
  }
}`;

export class GlPainter implements Painter {
  private readonly program: WebGLProgram;
  private readonly textures = new Map<FloatPicture, WebGLTexture>();
  private readonly places = new Map<string, WebGLUniformLocation | null>();

  /** `pictures`: the loaded ones, by the engine's index. Throws without WebGL 2. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly gl: WebGL2RenderingContext,
              private readonly pictures: ReadonlyMap<number, FloatPicture>) {
    this.program = this.linked();
    gl.useProgram(this.program);
    gl.bindVertexArray(gl.createVertexArray());
    gl.enable(gl.SCISSOR_TEST);
    ['ours', 'first', 'second'].forEach((name, unit) => gl.uniform1i(this.place(name), unit));
  }

  paint(width: number, height: number, panes: readonly Pane[], look: Look): void {
    const gl = this.gl;
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.scissor(0, 0, width, height);
    gl.clearColor(0.13, 0.13, 0.14, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    for (const pane of panes) this.paintPane(height, pane, look);
  }

  private paintPane(canvasHeight: number, pane: Pane, look: Look): void {
    const gl = this.gl, { content, at, view } = pane;
    const of = (engine: number): FloatPicture | undefined => this.pictures.get(engine);
    const [pictureA, pictureB] = content.kind === 'map' ? [content.picture, content.picture]
      : content.kind === 'picture' ? [of(content.engine), of(content.engine)] : [of(content.a), of(content.b)];
    const ours = of(0);
    if (!ours || !pictureA || !pictureB) return;
    [ours, pictureA, pictureB].forEach((picture, unit) => this.bind(unit, picture));
    const set = (name: string, value: number): void => gl.uniform1f(this.place(name), value);
    gl.uniform1i(this.place('what'),
      content.kind === 'difference' ? { absolute: 1, relative: 2, signed: 3 }[content.measure] : content.kind === 'map' ? 4 : 0);
    gl.uniform2i(this.place('fromOurs'), Number(pictureA.fromOurs), Number(pictureB.fromOurs));
    gl.uniform1i(this.place('falseColour'), Number(look.falseColour));
    gl.uniform3fv(this.place('map'), stopsOf(kColours[content.kind]));
    set('gain', 2 ** look.stops);
    set('top', look.top);
    set('decades', look.decades);
    set('white', content.kind === 'picture' ? 1 : content.white);
    set('zoom', view.zoom);
    set('canvasHeight', canvasHeight);
    gl.uniform4f(this.place('place'), at.x, at.y, view.x, view.y);
    gl.uniform2i(this.place('size'), ours.width, ours.height);
    gl.uniform1i(this.place('block'), pictureA.block);
    gl.scissor(at.x, canvasHeight - at.y - at.height, at.width, at.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  private bind(unit: number, picture: FloatPicture): void {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0 + unit);
    const known = this.textures.get(picture);
    if (known) { gl.bindTexture(gl.TEXTURE_2D, known); return; }
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB32F, picture.width, picture.height, 0, gl.RGB, gl.FLOAT, picture.values);
    this.textures.set(picture, texture);
  }

  private place(name: string): WebGLUniformLocation | null {
    let at = this.places.get(name);
    if (at === undefined) this.places.set(name, at = this.gl.getUniformLocation(this.program, name));
    return at;
  }

  private linked(): WebGLProgram {
    const gl = this.gl, program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, kVertex], [gl.FRAGMENT_SHADER, kFragment]] as const) {
      const shader = gl.createShader(type);
      if (!shader) throw new Error('no WebGL 2');
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS))
      throw new Error(gl.getProgramInfoLog(program) ?? 'no WebGL 2');
    return program;
  }
}
