float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float s = pow(max(dot(N, normalize(L + V)), 0.0), n);
    s = floor(s * 3.0) / 3.0;
    return (n + 1.0) / (8.0 * 3.14159265) * s * max(dot(N, L), 0.0);
}
