void light(vec3 N, vec3 V, vec3 L, float n, inout vec3 specular)
{
    vec3 H = normalize(L + V);
    specular += (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, H), 0.0), n) * max(dot(N, L), 0.0);
}
