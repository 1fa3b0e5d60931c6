vec3 shade(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 ambient = 0.1 * vec3(1.0);
    float spec = (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * max(dot(N, L), 0.0);
    return ambient + spec * vec3(1.0);
}
