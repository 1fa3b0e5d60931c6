#version 100
#extension GL_OES_standard_derivatives : enable
precision highp float;
varying vec3 vNormal, vLight, vEye;
uniform float shininess;
void main() {
  vec3 n = normalize(vNormal), l = normalize(vLight), e = normalize(vEye);
  float s = pow(clamp(dot(n, normalize(l + e)), 0.0, 1.0), shininess) * (shininess + 1.0) / 25.1327412;
  gl_FragColor = vec4(vec3(s * clamp(dot(n, l), 0.0, 1.0)), 1.0);
}
