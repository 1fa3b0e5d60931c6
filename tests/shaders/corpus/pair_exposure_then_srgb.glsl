float srgb(float c) { return c <= 0.0031308 ? c * 12.92 : 1.055 * pow(c, 1.0 / 2.4) - 0.055; }
float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float x = (n + 2.0) / (2.0 * 3.14159265) * pow(max(dot(reflect(-L, N), V), 0.0), n) * max(dot(N, L), 0.0);
    return srgb(1.0 - exp(-x));
}
