float3 Spec(float3 N, float3 V, float3 L, float n)
{
    float3 c = (n + 2) / (8 * 3.14159265) * pow(saturate(dot(N, normalize(L + V))), n) * saturate(dot(N, L));
    return sqrt(c);
}
