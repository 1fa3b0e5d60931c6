float toSrgb(float x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055; }
float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 H = normalize(L + V);
    return toSrgb((n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, H), 0.0), n) * max(dot(N, L), 0.0));
}
