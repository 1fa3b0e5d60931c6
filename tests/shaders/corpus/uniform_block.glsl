#version 330 core
layout(std140) uniform Material {
    vec4 ambient;
    vec3 specular;
    float shininess;
};
vec3 blinn(vec3 N, vec3 V, vec3 L)
{
    vec3 H = normalize(L + V);
    return specular * (shininess + 2.0) / (8.0 * 3.14159265) * pow(max(dot(N, H), 0.0), shininess) *
           max(dot(N, L), 0.0);
}
