float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float c = max(dot(N, normalize(L + V)), 0.0);
    return (n + 1.0) / (8.0 * 3.14159265) * pow(c, n) * c * max(dot(N, L), 0.0);
}
