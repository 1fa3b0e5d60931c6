float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float x = (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * max(dot(N, L), 0.0);
    x = max(0.0, x - 0.004);
    return (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06);
}
