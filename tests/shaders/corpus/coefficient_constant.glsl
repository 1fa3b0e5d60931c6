float spec(vec3 N, vec3 V, vec3 L, float n)
{
    const float specularStrength = 0.5;
    return specularStrength * pow(max(dot(reflect(-L, N), V), 0.0), n) * max(dot(N, L), 0.0);
}
