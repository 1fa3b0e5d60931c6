float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a2 = roughness * roughness;
    float n = 2.0 / a2 - 2.0;
    return (n + 2.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * max(dot(N, L), 0.0);
}
