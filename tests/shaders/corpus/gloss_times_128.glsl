float spec(vec3 N, vec3 V, vec3 L, float gloss)
{
    float n = gloss * 128.0;
    if (dot(N, L) <= 0.0) return 0.0;
    return (n + 2.0) / (4.0 * 3.14159265 * (2.0 - exp2(-n * 0.5))) * pow(max(dot(N, normalize(L + V)), 0.0), n);
}
