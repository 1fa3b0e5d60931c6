float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a2 = pow(roughness, 4.0);
    vec3 H = normalize(L + V);
    float nl = dot(N, L), nv = dot(N, V), nh = max(dot(N, H), 0.0);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    float f = (nh * a2 - nh) * nh + 1.0;
    float D = a2 / (3.14159265 * f * f);
    return D * 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
}
