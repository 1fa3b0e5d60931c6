mat3 frame(vec3 n)
{
    vec3 t = abs(n.z) < 0.9 ? normalize(cross(n, vec3(0.0, 0.0, 1.0))) : normalize(cross(n, vec3(1.0, 0.0, 0.0)));
    return mat3(t, cross(n, t), n);
}
float spec(vec3 N, vec3 V, vec3 L, float n)
{
    mat3 toLocal = transpose(frame(N));
    vec3 wo = toLocal * V, wi = toLocal * L;
    vec3 wh = normalize(wo + wi);
    return (n + 1.0) / (8.0 * 3.14159265) * pow(max(wh.z, 0.0), n) * max(wi.z, 0.0);
}
