float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float nl = smoothstep(0.0, 1.0, dot(N, L));
    return (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * nl;
}
