#version 330
uniform vec3 lightPosition, lightIntensity, cameraPosition;
uniform float shininess;
in vec3 vPos, vNormal;
out vec4 fragColor;
void main()
{
    vec3 d = lightPosition - vPos;
    float attenuation = 1.0 / dot(d, d);
    vec3 L = d * inversesqrt(dot(d, d)), V = normalize(cameraPosition - vPos), N = normalize(vNormal);
    float k = (shininess + 2.0) * (shininess + 4.0) / (8.0 * 3.14159265 * (pow(2.0, -0.5 * shininess) + shininess));
    float s = k * pow(max(dot(N, normalize(L + V)), 0.0), shininess) * max(dot(N, L), 0.0);
    fragColor = vec4(lightIntensity * attenuation * s, 1.0);
}
