#version 300 es
precision highp float;
#define RECIPROCAL_PI 0.3183098861837907
#define saturate(a) clamp(a, 0.0, 1.0)
uniform vec3 specular;
uniform float shininess;
uniform vec3 lightColor;
uniform vec3 lightDirection;
in vec3 vNormal;
in vec3 vViewPosition;
out highp vec4 pc_fragColor;

float G_BlinnPhong_Implicit() { return 0.25; }
float D_BlinnPhong(const in float shininess, const in float dotNH) {
    return RECIPROCAL_PI * (shininess * 0.5 + 1.0) * pow(dotNH, shininess);
}
vec3 BRDF_BlinnPhong(const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess) {
    vec3 halfDir = normalize(lightDir + viewDir);
    float dotNH = saturate(dot(normal, halfDir));
    float G = G_BlinnPhong_Implicit();
    float D = D_BlinnPhong(shininess, dotNH);
    return specularColor * (G * D);
}
void main() {
    vec3 normal = normalize(vNormal);
    vec3 viewDir = normalize(vViewPosition);
    float dotNL = saturate(dot(normal, lightDirection));
    vec3 irradiance = dotNL * lightColor;
    vec3 directSpecular = irradiance * BRDF_BlinnPhong(lightDirection, viewDir, normal, specular, shininess);
    pc_fragColor = vec4(directSpecular, 1.0);
}
