float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float s = (n + 2.0) / 6.28318530718 * pow(max(dot(reflect(-L, N), V), 0.0), n) * max(dot(N, L), 0.0);
    return pow(s, 2.2);
}
