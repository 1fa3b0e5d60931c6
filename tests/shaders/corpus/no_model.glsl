float Phong(vec3 N, vec3 V, vec3 L, float shininess)
{
    vec3 R = reflect(-L, N);
    return (shininess + 2.0) / (2.0 * 3.14159265) * pow(max(dot(R, V), 0.0), shininess) * max(dot(N, L), 0.0);
}
