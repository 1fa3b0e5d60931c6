float blinn(vec3 N, vec3 V, vec3 L, float n, float ks)
{
    return dot(N, L) > 0.0 ? ks * pow(max(dot(N, normalize(L + V)), 0.0), n) : 0.0;
}
