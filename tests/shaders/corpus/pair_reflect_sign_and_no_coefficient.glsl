vec3 specularLight(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 R = normalize(reflect(L, N));
    float s = pow(max(dot(R, V), 0.0), n);
    return vec3(1.0, 1.0, 1.0) * s * max(dot(N, L), 0.0);
}
