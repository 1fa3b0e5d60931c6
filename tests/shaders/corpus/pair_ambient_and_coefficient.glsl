vec3 shade(vec3 N, vec3 V, vec3 L, float n)
{
    float ambientStrength = 0.1;
    float spec = pow(max(dot(reflect(-L, N), V), 0.0), n) * max(dot(N, L), 0.0);
    return vec3(ambientStrength + spec);
}
