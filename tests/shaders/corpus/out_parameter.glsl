void lighting(in vec3 N, in vec3 V, in vec3 L, in float n, out vec3 specular)
{
    specular = vec3(0.0);
    float nl = dot(N, L);
    if (nl > 0.0) {
        vec3 R = reflect(-L, N);
        specular = vec3((n + 2.0) / (2.0 * 3.14159265) * pow(max(dot(R, V), 0.0), n) * nl);
    }
}
