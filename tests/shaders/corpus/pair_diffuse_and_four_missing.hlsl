float3 Shade(float3 N, float3 V, float3 L, float n)
{
    float ndl = saturate(dot(N, L));
    float3 diffuse = float3(0.8, 0.8, 0.8) / 3.14159265 * ndl;
    float3 specular = (n + 2) / (2 * 3.14159265) * pow(saturate(dot(N, normalize(L + V))), n) * ndl;
    return diffuse + specular;
}
