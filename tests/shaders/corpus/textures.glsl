#version 330 core
uniform sampler2D specularMap;
in vec2 uv;
vec3 phong(vec3 N, vec3 V, vec3 L, float shininess)
{
    vec3 tint = texture(specularMap, uv).rgb;
    if (dot(N, L) <= 0.0) return vec3(0.0);
    return tint * (shininess + 1.0) / (2.0 * 3.14159265) * pow(max(dot(reflect(-L, N), V), 0.0), shininess);
}
