#define RECIPROCAL_PI 0.3183098861837907
vec3 BRDF_BlinnPhong(const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in float shininess)
{
    vec3 halfDir = normalize(lightDir + viewDir);
    float dotNH = clamp(dot(normal, halfDir), 0.0, 1.0);
    float dotNL = clamp(dot(normal, lightDir), 0.0, 1.0);
    float D = RECIPROCAL_PI * (shininess * 0.5 + 1.0) * pow(dotNH, shininess);
    return vec3(1.0) * (0.25 * D) * dotNL;
}
