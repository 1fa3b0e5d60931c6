float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float c = dot(N, normalize(L + V));
    return (n + 1.0) / (8.0 * 3.14159265) * exp(-n * (1.0 - c)) * max(dot(N, L), 0.0);
}
