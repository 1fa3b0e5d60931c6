#version 300 es
precision highp float;
in vec3 vNormal, vView;
uniform vec3 uLight;
uniform float uShininess;
out vec4 o;
void main() {
  vec3 n = normalize(vNormal), h = normalize(normalize(vView) + uLight);
  o = vec4(vec3((uShininess + 2.0) / 8.0 * pow(max(dot(n, h), 0.0), uShininess) * max(dot(n, uLight), 0.0)), 1.0);
}
