#version 330 core
out vec4 FragColor;

in vec3 Normal;
in vec3 FragPos;

uniform vec3 lightPos;
uniform vec3 viewPos;
uniform vec3 lightColor;
uniform float shininess;

void main()
{
    vec3 norm = normalize(Normal);
    vec3 lightDir = normalize(lightPos - FragPos);
    vec3 viewDir = normalize(viewPos - FragPos);
    vec3 halfwayDir = normalize(lightDir + viewDir);
    float spec = 0.0;
    if (dot(norm, lightDir) > 0.0)
        spec = pow(max(dot(norm, halfwayDir), 0.0), shininess);
    float energyConservation = (2.0 + shininess) / (4.0 * 3.14159265 * (2.0 - exp2(-shininess / 2.0)));
    vec3 specular = energyConservation * spec * lightColor;
    FragColor = vec4(specular, 1.0);
}
