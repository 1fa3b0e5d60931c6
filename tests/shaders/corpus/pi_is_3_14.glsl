#define PI 3.14
float spec(vec3 N, vec3 V, vec3 L, float n)
{
    return (n + 2.0) / (2.0 * PI) * pow(max(dot(reflect(-L, N), V), 0.0), n) * max(dot(N, L), 0.0);
}
