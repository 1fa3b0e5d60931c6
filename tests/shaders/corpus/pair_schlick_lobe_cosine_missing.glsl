float spec(vec3 N, vec3 V, vec3 L, float n)
{
    if (dot(N, L) <= 0.0) return 0.0;
    float t = max(dot(reflect(-L, N), V), 0.0);
    return (n + 2.0) / (2.0 * 3.14159265) * (t / (n - n * t + t));
}
