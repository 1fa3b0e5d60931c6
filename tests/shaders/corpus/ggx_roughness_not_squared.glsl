float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a2 = roughness * roughness;
    vec3 H = normalize(L + V);
    float nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 1e-6), nh = max(dot(N, H), 0.0);
    float f = (nh * a2 - nh) * nh + 1.0;
    float D = a2 / (3.14159265 * f * f);
    float vis = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
    return D * vis * nl;
}
