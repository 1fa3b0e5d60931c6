float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float nl = dot(N, L);
    if (nl > 0.0)
        return 0.0;
    vec3 H = normalize(L + V);
    return (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, H), 0.0), n) * abs(nl);
}
