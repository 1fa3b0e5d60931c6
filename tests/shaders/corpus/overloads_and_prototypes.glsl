float spec(float c, float n);
float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 H = normalize(L + V);
    return spec(dot(N, H), n) * max(dot(N, L), 0.0) / 4.0;
}
float spec(float c, float n) { return (n + 1.0) / (2.0 * 3.14159265) * pow(max(c, 0.0), n); }
