static const float PI = 3.14159265f;

float BlinnPhong(float3 N, float3 V, float3 L, float n)
{
    float3 H = normalize(L + V);
    float D = (n + 1.0f) / (2.0f * PI) * pow(saturate(dot(N, H)), n);
    return D * 0.25f * saturate(dot(N, L));
}
