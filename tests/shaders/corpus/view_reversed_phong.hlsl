float Phong(float3 N, float3 V, float3 L, float n)
{
    float3 view = normalize(-V);
    float3 R = reflect(-L, N);
    return dot(N, L) > 0 ? (n + 1) / (2 * 3.14159265) * pow(max(dot(R, view), 0), n) : 0;
}
