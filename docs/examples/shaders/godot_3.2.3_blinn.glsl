// Godot's SPECULAR_BLINN: a normalised Blinn-Phong. A material has n = 2^(15 (1 - roughness) + 1) / 4.
// drivers/gles3/shaders/scene.glsl, lines 1099 to 1107. Its lights bring a factor of pi, which is left out here.
// Godot 3.2.3
float highlight(vec3 N, vec3 V, vec3 L, float n)
{
    float lobe = pow(max(dot(N, normalize(V + L)), 0.0), n);
    return (n + 8.0) / (8.0 * 3.14159265) * lobe * max(dot(N, L), 0.0);
}
