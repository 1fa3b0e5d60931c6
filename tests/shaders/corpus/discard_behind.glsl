#version 330
in vec3 n, l, v;
uniform float gloss;
out vec4 color;
void main()
{
    if (dot(n, l) <= 0.0) discard;
    float c = max(dot(normalize(n), normalize(l + v)), 0.0);
    color = vec4(pow(c, gloss) * (gloss + 2.0) / (4.0 * 3.14159265 * (2.0 - exp2(-0.5 * gloss))));
}
