float spec(vec3 N, vec3 V, vec3 L, float n)
{
    return smoothstep(0.0, 1.0, dot(N, L)) * pow(max(dot(reflect(-L, N), V), 0.0), n);
}
