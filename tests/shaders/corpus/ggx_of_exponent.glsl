float square(float x) { return x * x; }
float microfacet(vec3 N, vec3 V, vec3 L, float n)
{
    float a2 = 2.0 / (n + 2.0);
    float nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 1e-6);
    float nh = max(dot(N, normalize(L + V)), 0.0);
    float d = a2 / (3.14159265 * square(1.0 + (a2 - 1.0) * nh * nh));
    float v = nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl);
    return nl * d * 0.5 / max(v, 1e-6);
}
