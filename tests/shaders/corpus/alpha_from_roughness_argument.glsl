float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float m2 = roughness * roughness;
    float n = 2.0 / m2 - 2.0;
    return max(dot(N, L), 0.0) * pow(max(dot(N, normalize(L + V)), 0.0), n) / (4.0 * 3.14159265 * m2);
}
