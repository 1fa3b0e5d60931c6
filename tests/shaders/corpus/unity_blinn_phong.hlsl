struct SurfaceOutput
{
    float3 Normal;
    float Specular;
    float Gloss;
};
float LightingBlinnPhong(SurfaceOutput s, float3 lightDir, float3 viewDir)
{
    float3 h = normalize(lightDir + viewDir);
    float diff = max(0, dot(s.Normal, lightDir));
    float nh = max(0, dot(s.Normal, h));
    float spec = pow(nh, s.Specular * 128.0) * s.Gloss;
    return spec * diff;
}
