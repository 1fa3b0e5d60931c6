float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 H = normalize(L + V);
    float fresnel = 0.04 + (1.0 - 0.04) * pow(1.0 - dot(L, H), 5.0);
    return fresnel * (n + 8.0) / (8.0 * 3.14159265) * pow(max(dot(N, H), 0.0), n) * max(dot(N, L), 0.0);
}
