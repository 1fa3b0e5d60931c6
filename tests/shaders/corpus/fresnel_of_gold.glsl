vec3 F_Schlick(float u, vec3 f0) { return f0 + (vec3(1.0) - f0) * pow(1.0 - u, 5.0); }
vec3 spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a = roughness * roughness, a2 = a * a;
    vec3 H = normalize(L + V);
    float nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 1e-6), nh = max(dot(N, H), 0.0);
    float f = (nh * a2 - nh) * nh + 1.0;
    float D = a2 / (3.14159265 * f * f);
    float vis = 0.5 / max(nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2), 1e-7);
    return D * vis * F_Schlick(max(dot(L, H), 0.0), vec3(0.56)) * nl;
}
