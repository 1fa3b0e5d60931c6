// n = 16 only: no pow on this GPU
float spec16(vec3 N, vec3 V, vec3 L)
{
    float s = max(dot(N, normalize(L + V)), 0.0);
    s *= s;
    s *= s;
    s *= s;
    s *= s;
    return 17.0 / (8.0 * 3.14159265) * s * max(dot(N, L), 0.0);
}
