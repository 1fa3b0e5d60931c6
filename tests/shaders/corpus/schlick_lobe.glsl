float schlickPower(float t, float n) { return t / (n - n * t + t); }
float spec(vec3 N, vec3 V, vec3 L, float n, float k)
{
    float t = max(dot(reflect(-L, N), V), 0.0);
    return k * schlickPower(t, n) * max(dot(N, L), 0.0);
}
