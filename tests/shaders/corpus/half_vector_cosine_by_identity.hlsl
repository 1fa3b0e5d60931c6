// BRDF.ush / ShadingModels.ush
#define PI 3.1415926535897932f
float Pow2(float x) { return x * x; }
float Pow4(float x) { float xx = x * x; return xx * xx; }
struct BxDFContext { float NoV; float NoL; float VoL; float NoH; float VoH; };
void Init(inout BxDFContext Context, float3 N, float3 V, float3 L)
{
    Context.NoL = dot(N, L);
    Context.NoV = dot(N, V);
    Context.VoL = dot(V, L);
    float InvLenH = rsqrt(2 + 2 * Context.VoL);
    Context.NoH = saturate((Context.NoL + Context.NoV) * InvLenH);
    Context.VoH = saturate(InvLenH + InvLenH * Context.VoL);
}
float D_GGX(float a2, float NoH)
{
    float d = (NoH * a2 - NoH) * NoH + 1; // 2 mad
    return a2 / (PI * d * d);             // 4 mul, 1 rcp
}
float Vis_SmithJoint(float a2, float NoV, float NoL)
{
    float Vis_SmithV = NoL * sqrt(NoV * (NoV - NoV * a2) + a2);
    float Vis_SmithL = NoV * sqrt(NoL * (NoL - NoL * a2) + a2);
    return 0.5 * rcp(Vis_SmithV + Vis_SmithL);
}
float3 SpecularGGX(float Roughness, float3 N, float3 V, float3 L)
{
    BxDFContext Context;
    Init(Context, N, V, L);
    float a2 = Pow4(Roughness);
    if (Context.NoL <= 0 || Context.NoV <= 0) return 0;
    float D = D_GGX(a2, Context.NoH);
    float Vis = Vis_SmithJoint(a2, Context.NoV, Context.NoL);
    return (D * Vis) * Context.NoL;
}
