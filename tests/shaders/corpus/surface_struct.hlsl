struct SurfaceOutput
{
    float3 Albedo;
    float3 Normal;
    float Shininess;
    float Alpha;
};
float4 LightingPhong(SurfaceOutput s, float3 lightDir, float3 viewDir, float atten = 1.0)
{
    float diff = max(0, dot(s.Normal, lightDir));
    float3 r = 2.0 * dot(s.Normal, lightDir) * s.Normal - lightDir;
    float spec = pow(max(0, dot(r, viewDir)), s.Shininess);
    float4 c;
    c.rgb = spec * diff * (s.Shininess + 2) / 6.2831853;
    c.a = 1;
    return c;
}
