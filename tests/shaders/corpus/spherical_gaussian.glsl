float sg(vec3 axis, vec3 dir, float sharpness) { return exp(sharpness * (dot(axis, dir) - 1.0)); }
float spec(vec3 N, vec3 V, vec3 L, float lambda, float amplitude)
{
    return amplitude * sg(normalize(L + V), N, lambda) * max(dot(N, L), 0.0);
}
