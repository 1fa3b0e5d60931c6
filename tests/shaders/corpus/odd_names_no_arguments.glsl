float calc(vec3 p0, vec3 p1, vec3 p2, float p3) {
    float a = max(dot(p2, p0), 0.0);
    vec3 b = reflect(-p0, p2);
    return (p3 + 2.0) * pow(max(dot(b, p1), 0.0), p3) * a / 6.2831853;
}
