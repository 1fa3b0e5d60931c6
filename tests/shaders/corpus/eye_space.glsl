#ifdef GL_ES
precision highp float;
#endif
varying vec3 vPosition;
varying vec3 vNormal;
uniform vec3 uLightDir;
uniform float uShininess;
void main(void) {
    vec3 N = normalize(vNormal);
    vec3 L = normalize(uLightDir);
    vec3 E = normalize(-vPosition);
    vec3 H = normalize(L + E);
    float Kd = max(dot(L, N), 0.0);
    float Ks = pow(max(dot(N, H), 0.0), uShininess);
    float specular = Ks * (uShininess + 2.0) / (8.0 * 3.14159265);
    if (dot(L, N) < 0.0) specular = 0.0;
    gl_FragColor = vec4(vec3(specular * Kd), 1.0);
}
