float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 H = (L + V);
    return (n + 2.0) / (4.0 * 3.14159265 * (2.0 - exp2(-n * 0.5))) * pow(max(dot(N, H), 0.0), n) * max(dot(N, L), 0.0);
}
