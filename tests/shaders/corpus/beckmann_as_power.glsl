float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float x = acos(min(dot(N, normalize(L + V)), 1.0));
    return (n + 2.0) / (8.0 * 3.14159265) * exp(-n * x * x / 2.0) * max(dot(N, L), 0.0);
}
