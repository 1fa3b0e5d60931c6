float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float F = 0.04 + 0.96 * pow(1.0 - max(dot(N, V), 0.0), 5.0);
    return F * (n + 2.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * max(dot(N, L), 0.0);
}
