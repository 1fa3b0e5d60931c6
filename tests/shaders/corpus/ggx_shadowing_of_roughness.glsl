float distribution(float nh, float roughness)
{
    float a = roughness * roughness;
    float a2 = a * a;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    return a2 / (3.14159265 * d * d);
}
float geometry(float nl, float nv, float roughness)
{
    float a2 = roughness * roughness;
    return 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
}
float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 1e-6), nh = max(dot(N, normalize(L + V)), 0.0);
    return distribution(nh, roughness) * geometry(nl, nv, roughness) * nl;
}
