float G1(float c, float k) { return c / (c * (1.0 - k) + k); }
float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a = roughness * roughness, a2 = a * a;
    float k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    vec3 H = normalize(L + V);
    float nl = dot(N, L), nv = dot(N, V), nh = max(dot(N, H), 0.0);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    float t = nh * nh * (a2 - 1.0) + 1.0;
    float F = 0.04 + 0.96 * pow(1.0 - max(dot(H, V), 0.0), 5.0);
    return a2 / (3.14159265 * t * t) * F * G1(nl, k) * G1(nv, k) / (4.0 * nl * nv) * nl;
}
