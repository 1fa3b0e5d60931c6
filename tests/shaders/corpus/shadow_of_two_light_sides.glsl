float spec(vec3 N, vec3 V, vec3 L, float n)
{
    if (dot(N, L) < 0.0) N = -N;
    float k = (n + 2.0) * (n + 4.0) / (8.0 * 3.14159265 * (exp2(-n * 0.5) + n));
    return k * pow(max(dot(N, normalize(L + V)), 0.0), n) * dot(N, L);
}
