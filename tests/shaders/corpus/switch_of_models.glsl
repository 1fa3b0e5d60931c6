#version 330
uniform int model;
float specular(vec3 N, vec3 V, vec3 L, float shininess)
{
    float nl = max(dot(N, L), 0.0), c;
    switch (model) {
    case 0:
        c = max(dot(N, normalize(L + V)), 0.0);
        break;
    case 1:
        c = max(dot(reflect(-L, N), V), 0.0);
        break;
    default:
        c = 1.0;
    }
    return nl * (shininess + 2.0) / (2.0 * 3.14159265) * pow(c, shininess);
}
