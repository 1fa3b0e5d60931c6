float GGX(float3 N, float3 V, float3 L, float roughness)
{
    float a2 = pow(roughness, 4);
    float3 H = normalize(L + V);
    float nl = saturate(dot(N, L)), nv = max(dot(N, V), 1e-6), nh = saturate(dot(N, H));
    float d = nh * nh * (a2 - 1) + 1;
    float D = a2 / (d * d);
    float Vis = 0.5 / (nl * sqrt(nv * nv * (1 - a2) + a2) + nv * sqrt(nl * nl * (1 - a2) + a2));
    return D * Vis * nl;
}
