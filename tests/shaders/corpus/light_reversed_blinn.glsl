float spec(vec3 N, vec3 V, vec3 L, float n)
{
    vec3 lightDir = normalize(vec3(0.0) - L); // fragPos - lightPos
    vec3 H = normalize(lightDir + V);
    return (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, H), 0.0), n) * max(dot(N, lightDir), 0.0);
}
