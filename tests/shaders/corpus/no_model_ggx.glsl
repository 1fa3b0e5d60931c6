float D_GGX(float NoH, float roughness)
{
    float alpha = roughness * roughness;
    float a2 = alpha * alpha;
    float d = NoH * NoH * (a2 - 1.0) + 1.0;
    return a2 / (3.14159265 * d * d);
}
float V_Smith(float NoV, float NoL, float roughness)
{
    float a2 = pow(roughness, 4.0);
    float gv = NoL * sqrt(NoV * NoV * (1.0 - a2) + a2);
    float gl = NoV * sqrt(NoL * NoL * (1.0 - a2) + a2);
    return 0.5 / max(gv + gl, 1e-7);
}
float specularBRDF(vec3 N, vec3 V, vec3 L, float roughness)
{
    vec3 H = normalize(V + L);
    float NoV = max(dot(N, V), 0.0), NoL = max(dot(N, L), 0.0), NoH = max(dot(N, H), 0.0);
    return D_GGX(NoH, roughness) * V_Smith(NoV, NoL, roughness) * NoL;
}
