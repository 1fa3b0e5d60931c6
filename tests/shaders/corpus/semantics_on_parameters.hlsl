uniform float Power;
float4 ps_main(float3 n : TEXCOORD0, float3 l : TEXCOORD1, float3 v : TEXCOORD2) : COLOR
{
    n = normalize(n);
    float3 h = normalize(normalize(l) + normalize(v));
    float s = pow(max(dot(n, h), 0.0), Power) * max(dot(n, l), 0.0);
    return float4((s * (Power + 2.0) / (8.0 * 3.14159265)).xxx, 1.0);
}
