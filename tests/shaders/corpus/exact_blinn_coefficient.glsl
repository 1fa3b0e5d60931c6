float specBlinnPhong(vec3 N, vec3 V, vec3 L, float n)
{
    const float kPi = 3.14159265358979;
    // exact normalization, thetenthplanet.de/archives/255
    float norm = ((n + 2.0) * (n + 4.0)) / (8.0 * kPi * (pow(2.0, -n / 2.0) + n));
    vec3 H = normalize(V + L);
    float ndh = clamp(dot(N, H), 0.0, 1.0);
    float ndl = clamp(dot(N, L), 0.0, 1.0);
    return norm * pow(ndh, n) * ndl;
}
