float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 H = 0.5 * (L + V);
    return dot(N, L) > 0.0 ? (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, H), 0.0), n) : 0.0;
}
