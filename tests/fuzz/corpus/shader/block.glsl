#version 330
#define T(x) texture(map, x)
layout(std140) uniform M { vec4 color; float shininess; } m[2];
in vec3 vNormal, vPos;
#if defined(A) && (B > 1)
uniform sampler2D map;
#endif
out vec4 FragColor;
float f(in vec3 N, out vec3 s[2]) { vec3 vPos = vPos; return m[1].shininess + T(vec2(0)).x; }
void main() { gl_FragColor = vec4(f(vNormal)); }
