float spec(vec3 N, vec3 V, vec3 L, float m)
{
    float m2 = m * m;
    float nl = dot(N, L), nv = dot(N, V);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    float nh = dot(N, normalize(L + V));
    float t = nh * nh * (m2 - 1.0) + 1.0;
    float D = m2 / (3.14159265 * t * t);
    float G = 2.0 * nl * nv / (nl * sqrt(m2 + (1.0 - m2) * nv * nv) + nv * sqrt(m2 + (1.0 - m2) * nl * nl));
    return D * G / nv;
}
