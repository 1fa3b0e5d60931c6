float Spec(float3 N, float3 V, float3 L, float n)
{
    float t = saturate(dot(reflect(-L, N), V));
    return (n + 2) / (2 * 3.14159265) * t / (n - n * t + t) * saturate(dot(N, L));
}
