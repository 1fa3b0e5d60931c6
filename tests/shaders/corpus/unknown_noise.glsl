float spec(vec3 N, vec3 V, vec3 L, float n)
{
    float noise = fract(sin(dot(L, vec3(12.9898, 78.233, 37.719))) * 43758.5453);
    return (0.99 + 0.02 * noise) * (n + 2.0) / (2.0 * 3.14159265) * pow(max(dot(reflect(-L, N), V), 0.0), n) * max(dot(N, L), 0.0);
}
