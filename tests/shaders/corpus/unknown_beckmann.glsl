float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float a2 = 2.0 / (n + 2.0);
    float nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 1e-6), nh = max(dot(N, normalize(L + V)), 1e-4);
    float c2 = nh * nh;
    float D = exp((c2 - 1.0) / (a2 * c2)) / (3.14159265 * a2 * c2 * c2);
    float vis = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
    return D * vis * nl;
}
