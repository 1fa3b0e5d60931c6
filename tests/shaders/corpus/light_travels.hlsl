cbuffer Scene : register(b0)
{
    float3 LightDirection; // where the light travels
    float Shininess;
};
float4 PSMain(float4 pos : SV_POSITION, float3 nrm : NORMAL, float3 view : TEXCOORD0) : SV_TARGET
{
    float3 N = normalize(nrm), V = normalize(view), L = normalize(LightDirection);
    float3 R = reflect(-L, N);
    float s = (Shininess + 2) / (2 * 3.14159265) * pow(saturate(dot(R, V)), Shininess) * saturate(dot(N, L));
    return float4(s, s, s, 1);
}
