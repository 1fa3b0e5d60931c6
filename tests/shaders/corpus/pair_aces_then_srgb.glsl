float srgb(float c) { return c < 0.0031308 ? c * 12.92 : 1.055 * pow(c, 0.41666667) - 0.055; }
float aces(float x) { return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }
float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float x = (n + 2.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * max(dot(N, L), 0.0);
    return srgb(aces(x));
}
