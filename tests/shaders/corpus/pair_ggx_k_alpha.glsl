float G1(float c, float k) { return 1.0 / (c * (1.0 - k) + k); }
float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a2 = roughness * roughness, r1 = roughness + 1.0, k = r1 * r1 / 8.0;
    float nl = dot(N, L), nv = dot(N, V), nh = max(dot(N, normalize(L + V)), 0.0);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    float t = nh * nh * (a2 - 1.0) + 1.0;
    return a2 / (3.14159265 * t * t) * G1(nl, k) * G1(nv, k) * 0.25 * nl;
}
