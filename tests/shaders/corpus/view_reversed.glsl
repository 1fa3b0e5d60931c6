float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 viewDir = -V; // position - camera
    vec3 H = normalize(L + viewDir);
    return (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, H), 0.0), n) * max(dot(N, L), 0.0);
}
