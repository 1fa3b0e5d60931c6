float blinnPhong(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 toLight = normalize(-L);
    vec3 H = normalize(toLight + V);
    return (n + 2.0) / (2.0 * 3.14159265) * pow(max(dot(N, H), 0.0), n) * max(dot(N, toLight), 0.0);
}
