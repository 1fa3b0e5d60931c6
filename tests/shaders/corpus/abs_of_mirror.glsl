float spec(vec3 N, vec3 V, vec3 L, float n)
{
    return (n + 2.0) / (2.0 * 3.14159265) * pow(abs(dot(reflect(-L, N), V)), n) * max(dot(N, L), 0.0);
}
