float spec(vec3 N, vec3 V, vec3 L, float n)
{
    N = -N; // cross product in the wrong order
    vec3 R = reflect(-L, N);
    return (n + 2.0) / (2.0 * 3.14159265) * pow(max(dot(R, V), 0.0), n) * max(dot(N, L), 0.0);
}
