const float INV_PI = 0.31830988618;
float D(float c, float n) { return (n + 1.0) * 0.5 * INV_PI * pow(c, n); }
float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float d = D(max(dot(N, normalize(V + L)), 0.0), n);
    return d / 4.0 * INV_PI * max(dot(N, L), 0.0);
}
