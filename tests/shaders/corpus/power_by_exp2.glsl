float fastPow(float x, float n) { return x > 0.0 ? exp2(n * log2(x)) : 0.0; }

float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 H = normalize(L + V);
    return (n + 1.0) * 0.0397887357729738 * fastPow(dot(N, H), n) * max(dot(N, L), 0.0);
}
