float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float c = max(dot(reflect(-L, N), V), 0.0);
    return (0.7 * (n + 2.0) * pow(c, n) + 0.3 * (n / 5.0 + 2.0) * pow(c, n / 5.0)) / 6.28318530718 * max(dot(N, L), 0.0);
}
