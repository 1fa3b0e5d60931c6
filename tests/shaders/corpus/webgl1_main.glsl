precision highp float;

// Passed in from the vertex shader.
varying vec3 v_normal;
varying vec3 v_surfaceToLight;
varying vec3 v_surfaceToView;

uniform float u_shininess;

void main() {
  vec3 normal = normalize(v_normal);

  vec3 surfaceToLightDirection = normalize(v_surfaceToLight);
  vec3 surfaceToViewDirection = normalize(v_surfaceToView);
  vec3 halfVector = normalize(surfaceToLightDirection + surfaceToViewDirection);

  float light = max(dot(normal, surfaceToLightDirection), 0.0);
  float specular = 0.0;
  if (light > 0.0) {
    specular = pow(max(dot(normal, halfVector), 0.0), u_shininess);
  }
  float norm = (u_shininess + 1.0) / (8.0 * 3.14159265);
  gl_FragColor = vec4(vec3(norm * specular * light), 1.0);
}
