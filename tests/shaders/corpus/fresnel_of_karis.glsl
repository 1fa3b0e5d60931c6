float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a2 = pow(roughness, 4.0);
    vec3 H = normalize(L + V);
    float nl = dot(N, L), nv = dot(N, V), nh = dot(N, H), vh = dot(V, H);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    float d = (nh * a2 - nh) * nh + 1.0;
    float F = 0.04 + 0.96 * exp2((-5.55473 * vh - 6.98316) * vh);
    float vis = 0.5 / (nl * sqrt(nv * (nv - nv * a2) + a2) + nv * sqrt(nl * (nl - nl * a2) + a2));
    return F * a2 / (3.14159265 * d * d) * vis * nl;
}
