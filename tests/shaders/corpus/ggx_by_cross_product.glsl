float D_GGX(float roughness, float NoH, vec3 n, vec3 h) {
    vec3 NxH = cross(n, h);
    float a = NoH * roughness;
    float k = roughness / (dot(NxH, NxH) + a * a);
    return k * k * (1.0 / 3.14159265358979);
}
float V_SmithGGXCorrelated(float roughness, float NoV, float NoL) {
    float a2 = roughness * roughness;
    float lambdaV = NoL * sqrt((NoV - a2 * NoV) * NoV + a2);
    float lambdaL = NoV * sqrt((NoL - a2 * NoL) * NoL + a2);
    return 0.5 / (lambdaV + lambdaL);
}
vec3 specularLobe(vec3 n, vec3 v, vec3 l, float perceptualRoughness) {
    float NoL = dot(n, l), NoV = dot(n, v);
    if (NoL <= 0.0 || NoV <= 0.0) return vec3(0.0);
    vec3 h = normalize(v + l);
    float r = perceptualRoughness * perceptualRoughness;
    return vec3(D_GGX(r, dot(n, h), n, h) * V_SmithGGXCorrelated(r, NoV, NoL) * NoL);
}
