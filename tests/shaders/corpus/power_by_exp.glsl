float phongLobe(float c, float n) {
    if (c <= 0.0) return 0.0;
    return exp(n * log(c));
}
float shade(vec3 N, vec3 V, vec3 L, float n) {
    float nl = max(0.0, dot(N, L));
    vec3 R = normalize(2.0 * dot(N, V) * N - V);
    return nl * (n + 2.0) / (2.0 * 3.1415926) * phongLobe(dot(R, L), n);
}
