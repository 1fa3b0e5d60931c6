#define PI 3.141592653589793
uniform vec3 lightColor;
vec3 specular(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 irradiance = max(dot(N, L), 0.0) * lightColor;
    irradiance *= PI; // punctual light
    return irradiance * 0.25 * (n * 0.5 + 1.0) / PI * pow(max(dot(N, normalize(L + V)), 0.0), n);
}
