#version 330
in vec3 vNormal, vView;
uniform vec3 uLight;
uniform float uShininess;
out vec4 o;
vec4 LinearTosRGB(in vec4 value) {
  return vec4(mix(pow(value.rgb, vec3(0.41666)) * 1.055 - vec3(0.055), value.rgb * 12.92, vec3(lessThanEqual(value.rgb, vec3(0.0031308)))), value.a);
}
void main() {
  vec3 n = normalize(vNormal), v = normalize(vView);
  float s = (uShininess + 2.0) / 6.2831853 * pow(max(dot(reflect(-uLight, n), v), 0.0), uShininess) * max(dot(n, uLight), 0.0);
  o = LinearTosRGB(vec4(vec3(s), 1.0));
}
