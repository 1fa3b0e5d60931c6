float Spec(float3 N, float3 V, float3 L, float n)
{
    float rl = dot(reflect(-V, N), L);
    float p = rl > 1e-8 ? exp2(n * log2(rl)) : 0.0;
    float result = (n + 2) * p * max(dot(N, L), 0.0) / (2 * 3.14159265);
    return isnan(result) || isinf(result) ? 0.0 : result;
}
