float specularHighlight(vec3 normal, vec3 eyeDirection, vec3 lightDirection, float shininess)
{
    vec3 n = normalize(normal), e = normalize(eyeDirection), l = normalize(lightDirection);
    vec3 h = (l + e) * inversesqrt(dot(l + e, l + e));
    float nl = max(dot(n, l), 0.0);
    float nh = min(max(dot(n, h), 0.0), 1.0);
    return nl * (shininess + 1.0) * pow(nh, shininess) / (8.0 * 3.14159265);
}
