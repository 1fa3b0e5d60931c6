#define saturate(x) clamp(x, 0.0, 1.0)
#define INV_TWO_PI 0.15915494309

float specularTerm(in vec3 normal, in vec3 viewDir, in vec3 lightDir, in float shininess)
{
    vec3 reflected = reflect(-viewDir, normal);
    return saturate(dot(normal, lightDir)) * (shininess + 2.0) * INV_TWO_PI *
           pow(saturate(dot(reflected, lightDir)), shininess);
}
