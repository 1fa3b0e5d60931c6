float sqr(float x) { return x * x; }
vec3 mirror(vec3 d, vec3 n) { return 2.0 * dot(d, n) * n - d; }
float positive(float x) { return max(x, 0.0); }
float cosineLobe(vec3 a, vec3 b, float n) { return pow(positive(dot(a, b)), n); }
float normalization(float n) { return (n + 2.0) / (2.0 * 3.14159265); }
float evaluate(vec3 N, vec3 V, vec3 L, float n)
{
    return normalization(n) * cosineLobe(mirror(L, N), V, n) * positive(dot(N, L));
}
