float visibility(float nl, float nv, float a2)
{
    return 2.0 / (nl * sqrt(mix(nv * nv, 1.0, a2)) + nv * sqrt(mix(nl * nl, 1.0, a2)));
}
float cookTorrance(vec3 N, vec3 V, vec3 L, float n)
{
    float nl = dot(N, L), nv = dot(N, V);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    vec3 H = normalize(L + V);
    float D = (n + 2.0) * pow(max(dot(N, H), 0.0), n) / (2.0 * 3.14159265);
    return D * visibility(nl, nv, 2.0 / (n + 2.0)) * nl / 4.0;
}
