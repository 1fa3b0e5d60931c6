#version 330 core
struct DirLight { vec3 direction; vec3 specular; };
#define MAX_LIGHTS 4
uniform DirLight lights[MAX_LIGHTS];
uniform int count;
uniform float shine;
in vec3 vNormal;
in vec3 vView;
out vec4 color;

vec3 CalcDirLight(DirLight light, vec3 normal, vec3 viewDir)
{
    vec3 lightDir = normalize(-light.direction);
    float diff = max(dot(normal, lightDir), 0.0);
    vec3 reflectDir = reflect(-lightDir, normal);
    float spec = pow(max(dot(viewDir, reflectDir), 0.0), shine);
    return light.specular * spec * diff * (shine + 2.0) / (2.0 * 3.14159265);
}
void main()
{
    vec3 norm = normalize(vNormal);
    vec3 result = vec3(0.0);
    for (int i = 0; i < count; i++)
        result += CalcDirLight(lights[i], norm, normalize(vView));
    color = vec4(result, 1.0);
}
