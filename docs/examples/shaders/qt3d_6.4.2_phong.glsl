// Qt 3D's QPhongMaterial. n is shininess.
// src/extras/shaders/rhi/phong.inc.frag, lines 109 to 113; the same lines of gl3/phong.inc.frag
// Qt 3D 6.4.2
float highlight(vec3 N, vec3 V, vec3 L, float n)
{
    if (dot(N, L) <= 0.0 || n <= 0.0) return 0.0;
    return (n + 2.0) / 2.0 * pow(max(dot(reflect(-L, N), V), 0.0), n);
}
