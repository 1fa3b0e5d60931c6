#version 330
uniform vec4 LightPosition;
uniform vec4 EyePosition;
uniform float Shininess;
in vec4 Position;
in vec3 Normal;
layout(location = 0) out vec4 FragColor;
void main()
{
    vec3 n = normalize(Normal);
    vec3 s = normalize(vec3(LightPosition - Position));
    vec3 v = normalize(vec3(EyePosition - Position));
    vec3 r = reflect(-s, n);
    float sDotN = max(dot(s, n), 0.0);
    vec3 spec = vec3(0.0);
    if (sDotN > 0.0)
        spec = vec3(pow(max(dot(r, v), 0.0), Shininess)) * (Shininess + 1.0) / (2.0 * 3.14159265);
    FragColor = vec4(spec, 1.0);
}
