// Godot's SPECULAR_PHONG: the same coefficient on R.V, over 4 (N.L)(N.V) with a floor. n as in SPECULAR_BLINN.
// drivers/gles3/shaders/scene.glsl, lines 1109 to 1118. Its lights bring a factor of pi, which is left out here.
// Godot 3.2.3
float highlight(vec3 N, vec3 V, vec3 L, float n)
{
    float lobe = pow(max(dot(reflect(-L, N), V), 0.0), n);
    float cosines = max(dot(N, L), 0.0) * max(dot(N, V), 0.0);
    return (n + 8.0) / (8.0 * 3.14159265) * lobe / max(4.0 * cosines, 0.75);
}
