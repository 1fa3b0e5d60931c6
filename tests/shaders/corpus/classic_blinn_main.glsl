#version 100
precision highp float;
varying vec3 v_normal;
varying vec3 v_light;
varying vec3 v_view;
uniform float u_shininess;
void main() {
  vec3 normal = normalize(v_normal);
  vec3 halfVector = normalize(normalize(v_light) + normalize(v_view));
  float light = dot(normal, normalize(v_light));
  float specular = 0.0;
  if (light > 0.0) {
    specular = pow(dot(normal, halfVector), u_shininess);
  }
  gl_FragColor.rgb = vec3(specular);
  gl_FragColor.a = 1.0;
}
