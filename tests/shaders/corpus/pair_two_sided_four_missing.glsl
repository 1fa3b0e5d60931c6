float spec(vec3 N, vec3 V, vec3 L, float n)
{
    return (n + 1.0) / (2.0 * 3.14159265) * pow(abs(dot(N, normalize(L + V))), n) * abs(dot(N, L));
}
