float geometrySchlick(float c, float k) { return 1.0 / (c * (1.0 - k) + k); }
float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a = roughness * roughness, a2 = a * a, k = a / 2.0;
    vec3 H = normalize(L + V);
    float nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 0.0), nh = max(dot(N, H), 0.0);
    float t = nh * nh * (a2 - 1.0) + 1.0;
    return a2 / (3.14159265 * t * t) * geometrySchlick(nl, k) * geometrySchlick(nv, k) / 4.0 * nl;
}
