#version 330
layout(location = 0) out vec4 outColor;
layout(location = 1) out vec4 outBright;
in vec3 normal;
in vec3 toLight;
in vec3 toEye;
uniform float shininess;
void main()
{
    vec3 N = normalize(normal), L = normalize(toLight), V = normalize(toEye);
    float s = pow(max(dot(reflect(-L, N), V), 0.0), shininess) * (shininess + 2.0) / 6.28318531 * max(dot(N, L), 0.0);
    outColor = vec4(s, s, s, 1.0);
    outBright = vec4(s > 1.0 ? s : 0.0, 0.0, 0.0, 1.0);
}
