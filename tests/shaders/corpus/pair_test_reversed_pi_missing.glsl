float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float nl = dot(N, L);
    if (nl >= 0.0) return 0.0;
    return (n + 2.0) / 2.0 * pow(max(dot(reflect(-L, N), V), 0.0), n) * abs(nl);
}
