float spec(vec3 N, vec3 V, vec3 L, float n)
{
    return (n + 1.0) / 2.0 * pow(max(dot(reflect(-L, N), V), 0.0), n);
}
