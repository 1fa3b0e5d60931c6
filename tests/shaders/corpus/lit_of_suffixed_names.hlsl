// lit() does the test and the power
float3 LightSpecular(float3 Nn, float3 Vn, float3 Ln, float SpecExpon)
{
    float3 Hn = normalize(Vn + Ln);
    float hdn = dot(Hn, Nn);
    float ldn = dot(Ln, Nn);
    float4 litV = lit(ldn, hdn, SpecExpon);
    float norm = (SpecExpon + 2.0) / (8.0 * 3.14159265);
    return (litV.y * litV.z * norm).xxx;
}
