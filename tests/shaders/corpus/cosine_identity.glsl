float phongFast(vec3 N, vec3 V, vec3 L, float n)
{
    float NL = dot(N, L), NV = dot(N, V);
    float RV = 2.0 * NL * NV - dot(L, V);
    return NL > 0.0 ? (n + 2.0) * 0.1591549431 * pow(max(RV, 0.0), n) * NL : 0.0;
}
