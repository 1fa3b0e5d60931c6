float spec(vec3 N, vec3 V, vec3 L, float n)
{
    if (dot(N, L) <= 0.0) return 0.0;
    float s = pow(max(dot(N, normalize(L + V)), 0.0), 32.0);
    return (n + 2.0) / (4.0 * 3.14159265 * (2.0 - exp2(-n * 0.5))) * s;
}
