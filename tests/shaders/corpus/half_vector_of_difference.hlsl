float Spec(float3 N, float3 V, float3 L, float n)
{
    float3 H = normalize(L - V);
    return (n + 2) / (8 * 3.14159265) * pow(saturate(dot(N, H)), n) * saturate(dot(N, L));
}
