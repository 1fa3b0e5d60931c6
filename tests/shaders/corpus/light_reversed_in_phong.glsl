vec3 phong(vec3 N, vec3 V, vec3 L, float shininess)
{
    vec3 lightDir = -L;
    float diff = max(dot(N, lightDir), 0.0);
    vec3 reflectDir = reflect(-lightDir, N);
    float spec = pow(max(dot(V, reflectDir), 0.0), shininess);
    return vec3((shininess + 2.0) / 6.2831853 * spec * diff);
}
