uniform float Ns;
float spec(vec3 N, vec3 V, vec3 L)
{
    float n = Ns / 1000.0;
    return (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * max(dot(N, L), 0.0);
}
