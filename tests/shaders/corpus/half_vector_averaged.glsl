float blinn(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 halfway = (L + V) / 2.0;
    float k = (n + 2.0) * (n + 4.0) / (8.0 * 3.14159265 * (exp2(-n * 0.5) + n));
    return k * pow(max(dot(halfway, N), 0.0), n) * max(dot(N, L), 0.0);
}
