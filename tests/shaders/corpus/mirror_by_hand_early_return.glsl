float phongRdf(vec3 n, vec3 v, vec3 l, float exponent)
{
    float nl = dot(n, l);
    if (nl <= 0.0)
        return 0.0;
    vec3 r = 2.0 * nl * n - l;
    float rv = dot(r, v);
    if (rv <= 0.0)
        return 0.0;
    return (exponent + 1.0) / 6.28318530718 * pow(rv, exponent);
}
