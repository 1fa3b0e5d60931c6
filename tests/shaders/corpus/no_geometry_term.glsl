float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float nv = dot(N, V), nl = dot(N, L);
    if (nv <= 0.0 || nl <= 0.0) return 0.0;
    float D = (n + 2.0) / (2.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n);
    return D / (4.0 * nl * nv) * nl;
}
