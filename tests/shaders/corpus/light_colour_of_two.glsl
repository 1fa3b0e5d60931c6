#version 330
uniform vec3 lightColor;
uniform float shininess;
vec3 specular(vec3 N, vec3 V, vec3 L)
{
    vec3 H = normalize(L + V);
    return lightColor * (shininess + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, H), 0.0), shininess) * max(dot(N, L), 0.0);
}
