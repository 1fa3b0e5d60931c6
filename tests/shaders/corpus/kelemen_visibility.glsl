float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a2 = pow(roughness, 4.0);
    vec3 H = normalize(L + V);
    float nh = max(dot(N, H), 0.0), lh = max(dot(L, H), 1e-4);
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float V_Kelemen = 0.25 / (lh * lh);
    return a2 / (3.14159265 * d * d) * V_Kelemen * max(dot(N, L), 0.0);
}
