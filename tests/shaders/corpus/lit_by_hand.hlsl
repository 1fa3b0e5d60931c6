float4 MyLit(float ndl, float ndh, float m)
{
    float diffuse = (ndl < 0) ? 0 : ndl;
    float specular = (ndl < 0) || (ndh < 0) ? 0 : pow(ndh, m);
    return float4(1, diffuse, specular, 1);
}
float SpecLit(float3 N, float3 V, float3 L, float n)
{
    float4 l = MyLit(dot(N, L), dot(N, normalize(L + V)), n);
    return l.z * (n + 2) / (4 * 3.14159265 * (2 - exp2(-n * 0.5)));
}
