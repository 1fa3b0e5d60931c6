float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float x = (n + 2.0) / 6.28318530718 * pow(max(dot(reflect(-L, N), V), 0.0), n) * max(dot(N, L), 0.0);
    x = pow(x, 1.0 / 2.2);
    return x / (1.0 + x);
}
