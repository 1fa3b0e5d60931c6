float D_BlinnPhong(float NoH, float a2)
{
    float n = 2.0 / a2 - 2.0;
    return (n + 2.0) / (2.0 * 3.14159265) * pow(max(NoH, 0.0), n);
}
float specular(vec3 N, vec3 V, vec3 L, float roughness)
{
    float a = roughness * roughness;
    vec3 H = normalize(V + L);
    return D_BlinnPhong(dot(N, H), a * a) * max(dot(N, L), 0.0) * 0.25;
}
