float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 H = (L + V) * 0.5;
    return dot(N, L) > 0.0 ? (n + 3.0) / 7.0 * pow(max(dot(N, H), 0.0), n * 1.5) * max(dot(N, V), 0.0) : 0.0;
}
