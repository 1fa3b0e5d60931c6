#version 330 core
in vec3 vN, vL, vV;
uniform float n;
out vec4 FragColor;
void main()
{
    vec3 N = normalize(vN), L = normalize(vL), V = normalize(vV);
    float nl = max(dot(N, L), 0.0);
    vec3 color = vec3((n + 2.0) / (2.0 * 3.14159265) * pow(max(dot(reflect(-L, N), V), 0.0), n) * nl);
    const float gamma = 2.2;
    FragColor = vec4(pow(color, vec3(1.0 / gamma)), 1.0);
}
