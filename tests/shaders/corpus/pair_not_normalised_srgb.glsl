float toSrgb(float x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055; }
float spec(vec3 N, vec3 V, vec3 L, float n)
{
    if (dot(N, L) <= 0.0) return 0.0;
    return toSrgb(pow(max(dot(N, normalize(L + V)), 0.0), n));
}
