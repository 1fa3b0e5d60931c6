float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a = roughness * roughness, a2 = a * a;
    float nh = max(dot(N, normalize(L + V)), 0.0);
    float t = (nh * a2 - nh) * nh + 1.0;
    return a2 / (3.14159265 * t * t) * max(dot(N, L), 0.0);
}
