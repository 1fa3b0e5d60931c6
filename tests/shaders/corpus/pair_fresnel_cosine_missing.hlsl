float3 FresnelSchlick(float3 f0, float c) { return f0 + (1 - f0) * pow(1 - c, 5); }
float3 Spec(float3 N, float3 V, float3 L, float n)
{
    float3 H = normalize(L + V);
    float lit = dot(N, L) > 0 ? 1 : 0;
    return lit * FresnelSchlick(float3(0.04, 0.04, 0.04), saturate(dot(L, H))) * (n + 2) / (8 * 3.14159265) * pow(saturate(dot(N, H)), n);
}
