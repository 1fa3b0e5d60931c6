float Phong(float3 N, float3 V, float3 L, float n)
{
    if (dot(N, L) <= 0) return 0;
    return (n + 1) / (2 * 3.14159265) * pow(saturate(dot(reflect(V, N), L)), n);
}
