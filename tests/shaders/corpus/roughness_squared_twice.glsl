float blinn(float nh, float alpha)
{
    float a2 = alpha * alpha;
    return pow(nh, 2.0 / a2 - 2.0) / (3.14159265 * a2);
}
float spec(vec3 N, vec3 V, vec3 L, float roughness)
{
    float alpha = roughness * roughness;
    return 0.25 * blinn(max(dot(N, normalize(L + V)), 0.0), alpha * alpha) * max(dot(N, L), 0.0);
}
