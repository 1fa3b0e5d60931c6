#define UNITY_PI 3.14159265359f
inline float SmithJointGGXVisibilityTerm(float NdotL, float NdotV, float roughness)
{
    float a2 = roughness * roughness;
    float lambdaV = NdotL * sqrt((-NdotV * a2 + NdotV) * NdotV + a2);
    float lambdaL = NdotV * sqrt((-NdotL * a2 + NdotL) * NdotL + a2);
    return 0.5f / (lambdaV + lambdaL + 1e-5f);
}
inline float GGXTerm(float NdotH, float roughness)
{
    float a2 = roughness * roughness;
    float d = (NdotH * a2 - NdotH) * NdotH + 1.0f;
    return a2 / (UNITY_PI * (d * d + 1e-7f));
}
float BRDF1(float3 normal, float3 viewDir, float3 lightDir, float perceptualRoughness)
{
    float roughness = perceptualRoughness * perceptualRoughness;
    float3 h = normalize(lightDir + viewDir);
    float nl = saturate(dot(normal, lightDir)), nv = abs(dot(normal, viewDir)), nh = saturate(dot(normal, h));
    return SmithJointGGXVisibilityTerm(nl, nv, roughness) * GGXTerm(nh, roughness) * nl;
}
