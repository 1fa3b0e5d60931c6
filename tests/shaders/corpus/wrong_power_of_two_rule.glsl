float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float n = exp2(10.0 * (1.0 - roughness) + 1.0);
    return (n + 2.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * max(dot(N, L), 0.0);
}
