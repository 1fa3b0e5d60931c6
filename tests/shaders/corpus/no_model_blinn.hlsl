float Blinn(float3 N, float3 V, float3 L, float n)
{
    float3 H = normalize(L + V);
    float k = (n + 2) * (n + 4) / (8 * 3.14159265 * (exp2(-n / 2) + n));
    return k * pow(saturate(dot(N, H)), n) * saturate(dot(N, L));
}
