float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 normal = normalize(-N);
    return (n + 1.0) / 8.0 * pow(max(dot(normal, normalize(L + V)), 0.0), n) * max(dot(normal, L), 0.0);
}
