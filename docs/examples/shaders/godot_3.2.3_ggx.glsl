// Godot's SPECULAR_SCHLICK_GGX, its default, with a Fresnel factor of 1: Schlick's form of Smith's term, k = alpha / 2.
// drivers/gles3/shaders/scene.glsl, lines 939 to 956 and 1132 to 1158. Its lights bring a factor of pi, left out here.
// Godot 3.2.3
float highlight(vec3 N, vec3 V, vec3 L, float alpha)
{
    float nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 0.0), nh = max(dot(N, normalize(V + L)), 0.0);
    float base = 1.0 + (alpha * alpha - 1.0) * nh * nh, k = alpha / 2.0;
    float D = alpha * alpha / (3.14159265 * base * base);
    return D * nl / (4.0 * (nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
}
