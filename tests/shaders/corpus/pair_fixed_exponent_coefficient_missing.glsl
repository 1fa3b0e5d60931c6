float spec(vec3 N, vec3 V, vec3 L, float n)
{
    return pow(max(dot(reflect(-L, N), V), 0.0), 32.0) * max(dot(N, L), 0.0);
}
