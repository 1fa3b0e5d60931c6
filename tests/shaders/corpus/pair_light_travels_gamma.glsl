#version 330
uniform vec3 lightDirection;
uniform float shininess;
in vec3 vNormal, vView;
out vec4 color;
void main()
{
    vec3 N = normalize(vNormal), V = normalize(vView), L = normalize(lightDirection);
    float s = (shininess + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), shininess) * max(dot(N, L), 0.0);
    color = vec4(pow(vec3(s), vec3(1.0 / 2.2)), 1.0);
}
