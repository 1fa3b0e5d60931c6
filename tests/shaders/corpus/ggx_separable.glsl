float G1(float c, float a2) { return 2.0 * c / (c + sqrt(a2 + (1.0 - a2) * c * c)); }
float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a2 = pow(roughness, 4.0);
    vec3 H = normalize(L + V);
    float nl = dot(N, L), nv = dot(N, V), nh = max(dot(N, H), 0.0);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    float t = nh * nh * (a2 - 1.0) + 1.0;
    float D = a2 / (3.14159265 * t * t);
    return D * G1(nl, a2) * G1(nv, a2) / (4.0 * nv);
}
