float shade(vec3 N, vec3 V, vec3 L, float n)
{
    float nl = max(dot(N, L), 0.0);
    float s = (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * nl;
    return pow(0.5 * nl + s, 1.0 / 2.2);
}
