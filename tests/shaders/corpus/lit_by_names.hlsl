float3 LightSpecular(float3 N, float3 V, float3 L, float specExp)
{
    float4 c = lit(dot(N, L), dot(N, normalize(V + L)), specExp);
    return c.y * c.z * (specExp + 2.0) / (8.0 * 3.14159265);
}
