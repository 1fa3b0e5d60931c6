float rdf(vec3 N, vec3 V, vec3 L, float n)
{
    float lit = 1.0 - step(dot(N, L), 0.0);
    float ndoth = max(dot(N, normalize(L + V)), 0.0);
    return lit * (n + 2.0) / (4.0 * 3.14159265 * (2.0 - exp2(-0.5 * n))) * pow(ndoth, n);
}
