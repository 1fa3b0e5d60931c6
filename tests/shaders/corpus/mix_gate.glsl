float specular(vec3 norm, vec3 eye, vec3 light, float power)
{
    float c = dot(norm, light);
    float s = pow(max(dot(reflect(-light, norm), eye), 0.0), power);
    float front = c > 0.0 ? 1.0 : 0.0;
    return mix(0.0, s * (power + 1.0) / (2.0 * radians(180.0)), front);
}
