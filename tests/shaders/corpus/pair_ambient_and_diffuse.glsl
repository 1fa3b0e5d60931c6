vec3 shade(vec3 N, vec3 V, vec3 L, float n)
{
    float diff = max(dot(N, L), 0.0);
    float spec = (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * diff;
    return vec3(0.1) + 0.5 * diff * vec3(1.0) + vec3(spec);
}
