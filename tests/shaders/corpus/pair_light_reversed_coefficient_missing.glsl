float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 lightDir = normalize(-L);
    return pow(max(dot(reflect(-lightDir, N), V), 0.0), n) * max(dot(N, lightDir), 0.0);
}
