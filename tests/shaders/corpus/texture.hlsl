Texture2D tex : register(t0);
SamplerState samp : register(s0);
cbuffer PerFrame : register(b0) { float3 lightDir; float shininess; };
struct VS_OUT { float4 pos : SV_Position; float3 norm : NORMAL; float3 view : TEXCOORD1; float2 uv : TEXCOORD0; };

float4 main(VS_OUT input) : SV_Target0
{
    float3 N = normalize(input.norm);
    float3 H = normalize(lightDir + normalize(input.view));
    float3 spec = tex.Sample(samp, input.uv).rgb * pow(saturate(dot(N, H)), shininess);
    return float4(spec * saturate(dot(N, lightDir)) * (shininess + 1) / (8 * 3.14159265), 1);
}
