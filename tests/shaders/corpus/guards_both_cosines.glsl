float eval(vec3 wo, vec3 wi, vec3 n, float e)
{
    float cosO = dot(n, wo), cosI = dot(n, wi);
    if (cosO <= 0.0 || cosI <= 0.0) return 0.0;
    vec3 m = normalize(wo + wi);
    float c = ((e + 2.0) * (e + 4.0)) / (8.0 * 3.14159265 * (exp2(-e / 2.0) + e));
    return c * pow(dot(n, m), e) * cosI;
}
