#version 450
layout(location = 0) in vec3 vNormal;
layout(location = 1) in vec3 vView;
layout(location = 0) out vec4 outColor;
layout(push_constant) uniform Push { vec3 light; float n; } pc;

void main()
{
    vec3 N = normalize(vNormal), V = normalize(vView), L = normalize(pc.light);
    float nl = max(dot(N, L), 0.0);
    outColor = vec4(vec3((pc.n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), pc.n) * nl), 1.0);
}
