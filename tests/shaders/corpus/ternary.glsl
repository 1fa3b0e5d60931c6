float highlight(vec3 N, vec3 V, vec3 L, float m)
{
    vec3 h = L + V;
    h /= length(h);
    float c = dot(N, L);
    float d = dot(N, h);
    return c > 0.0 && d > 0.0 ? (m + 2.0) * pow(d, m) * c / (8.0 * acos(-1.0)) : 0.0;
}
