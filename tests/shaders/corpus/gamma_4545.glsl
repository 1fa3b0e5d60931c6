float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 H = normalize(L + V), R = reflect(-V, N);
    float nh = max(dot(N, H), 0.0), rl = max(dot(R, L), 0.0), nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 0.0), vh = max(dot(V, H), 0.0);
    float p = (n + 2.0) / (2.0 * 3.14159265) * pow(rl, n) * nl, b = (n + 2.0) / (8.0 * 3.14159265) * pow(nh, n) * nl;
    return pow(b, 0.4545);
}
