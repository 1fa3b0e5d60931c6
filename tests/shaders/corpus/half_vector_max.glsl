const float PI = 3.14159265359;

float blinnPhongSpecular(vec3 N, vec3 V, vec3 L, float shininess)
{
    vec3 H = normalize(L + V);
    float spec = pow(max(dot(N, H), 0.0), shininess);
    return (shininess + 1.0) / (8.0 * PI) * spec * max(dot(N, L), 0.0);
}
