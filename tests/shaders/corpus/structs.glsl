struct Light { vec3 direction; vec3 color; };
struct Material { vec3 specular; float shininess; };

vec3 shade(Light light, Material mat, vec3 N, vec3 V)
{
    vec3 H = normalize(light.direction + V);
    float f = pow(max(0.0, dot(N, H)), mat.shininess) * (mat.shininess + 1.0) / (8.0 * 3.14159265);
    return light.color * mat.specular * f * max(0.0, dot(N, light.direction));
}
