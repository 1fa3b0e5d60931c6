cbuffer MaterialConstants : register(b0)
{
    float3 SpecularColor;
    float Shininess;
    float3 LightDirection; // the direction the light travels
};

struct PSInput
{
    float4 position : SV_POSITION;
    float3 nrm : NORMAL;
    float3 view : TEXCOORD0;
};

float4 PSMain(PSInput input) : SV_TARGET
{
    float3 N = normalize(input.nrm);
    float3 V = normalize(input.view);
    float3 L = normalize(-LightDirection);
    float3 R = reflect(-L, N);
    float ndl = saturate(dot(N, L));
    float s = (Shininess + 2) / (2 * 3.14159265) * pow(saturate(dot(R, V)), Shininess);
    return float4(SpecularColor * s * ndl, 1);
}
