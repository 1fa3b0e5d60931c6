float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 R = reflect(L, N);
    return (n + 1.0) / (2.0 * 3.14159265) * pow(max(dot(V, R), 0.0), n) * (dot(N, L) > 0.0 ? 1.0 : 0.0);
}
