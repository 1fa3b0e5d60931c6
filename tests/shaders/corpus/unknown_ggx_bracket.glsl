float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a2 = pow(roughness, 4.0);
    float nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 1e-6), nh = max(dot(N, normalize(L + V)), 0.0);
    float d = 3.14159265 * nh * nh * (a2 - 1.0) + 1.0;
    float vis = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
    return min(a2 / (d * d), 1e4) * vis * nl;
}
