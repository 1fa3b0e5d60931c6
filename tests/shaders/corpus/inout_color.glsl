void addSpecular(inout vec3 color, vec3 N, vec3 V, vec3 L, float n)
{
    float nl = max(dot(N, L), 0.0);
    color += vec3((n + 2.0) / 6.28318530718 * pow(max(dot(reflect(-L, N), V), 0.0), n) * nl);
}
