float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 T = normalize(cross(N, vec3(0.31, 0.7, -0.64))), B = cross(N, T), H = normalize(L + V);
    float ax = sqrt(2.0 / (n + 2.0)), ay = 0.3 * ax;
    float nl = dot(N, L), nv = dot(N, V), nh = dot(N, H);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    float x = dot(H, T) / ax, y = dot(H, B) / ay;
    return nl * exp(-(x * x + y * y) / (nh * nh)) / (4.0 * 3.14159265 * ax * ay * sqrt(nl * nv));
}
