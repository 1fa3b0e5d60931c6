#version 430
float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float c = max(dot(N, normalize(L + V)), 0.0);
    float h = unpackHalf2x16(packHalf2x16(vec2(c, 0.0))).x;
    return (n + 1.0) / (8.0 * 3.14159265) * pow(h, n) * max(dot(N, L), 0.0);
}
