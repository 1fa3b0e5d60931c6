precision highp float;
varying vec3 vPosition;
varying vec3 vNormal;
uniform vec3 uLightDir;
uniform float uShininess;
void main(void) {
    vec3 N = normalize(vNormal);
    vec3 L = normalize(uLightDir);
    vec3 E = normalize(vPosition);
    vec3 H = normalize(L + E);
    float s = pow(max(dot(N, H), 0.0), uShininess) * (uShininess + 2.0) / (8.0 * 3.14159265);
    gl_FragColor = vec4(vec3(s * max(dot(L, N), 0.0)), 1.0);
}
