float n : SHININESS < string UIName = "n"; > = 30;
cbuffer M : register(b0) { row_major float4x4 W : packoffset(c0); float3 c, d[2]; };
Texture2D<float4> map : register(t0); SamplerState s { Filter = X; };
StructuredBuffer<float3> lights;
struct V { float4 p : SV_Position; float3 normal : NORMAL; } v;
float4 main(V i, float k = 1) : SV_Target { return map.Sample(s, i.p.xy) * n + tex2D(s, d[0].xy); }
technique T { pass P { } }
