float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 R = reflect(-V, N);
    float rl = max(dot(R, L), 0.0), nl = max(dot(N, L), 0.0);
    return pow((n + 2.0) / (2.0 * 3.14159265) * pow(rl, 2.0 * n) * nl, 0.4545);
}
