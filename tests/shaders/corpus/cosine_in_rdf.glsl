float spec(vec3 N, vec3 V, vec3 L, float n)
{
    return (n + 1.0) / 6.2831853 * pow(max(dot(reflect(-V, N), L), 0.0), n) * max(dot(N, L), 0.0);
}
