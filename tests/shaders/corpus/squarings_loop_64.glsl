float sharp(vec3 N, vec3 V, vec3 L)
{
    float x = max(dot(reflect(-L, N), V), 0.0);
    for (int i = 0; i < 6; ++i)
        x = x * x;
    return x * 66.0 / 6.2831853 * max(dot(N, L), 0.0);
}
