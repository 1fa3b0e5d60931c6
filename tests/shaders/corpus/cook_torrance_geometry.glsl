float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 H = normalize(L + V);
    float nl = dot(N, L), nv = dot(N, V), nh = max(dot(N, H), 0.0), vh = max(dot(V, H), 1e-6);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    float G = min(1.0, min(2.0 * nh * nv / vh, 2.0 * nh * nl / vh));
    return (n + 2.0) / (2.0 * 3.14159265) * pow(nh, n) * G / (4.0 * nv);
}
