float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 l = -L;
    return (n + 1.0) / (2.0 * 3.14159265) * pow(max(dot(N, normalize(l + V)), 0.0), n) * max(dot(N, l), 0.0);
}
