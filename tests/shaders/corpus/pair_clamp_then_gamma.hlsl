float3 Spec(float3 N, float3 V, float3 L, float n)
{
    float3 c = (n + 1) / (8 * 3.14159265) * pow(saturate(dot(N, normalize(L + V))), n) * saturate(dot(N, L));
    return pow(saturate(c), 1.0 / 2.2);
}
