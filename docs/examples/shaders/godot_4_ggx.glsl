// Godot's SPECULAR_SCHLICK_GGX, its default, with a Fresnel factor of 1: Hammon's form of the height-correlated Smith term.
// servers/rendering/renderer_rd/shaders/scene_forward_lights_inc.glsl, lines 3 to 12. Light above the horizon only.
// Godot 4, commit 001d4b23
float highlight(vec3 N, vec3 V, vec3 L, float alpha)
{
    float nl = max(dot(N, L), 0.0), nv = max(dot(N, V), 1e-4), nh = clamp(dot(N, normalize(V + L)), 0.0, 1.0);
    float k = alpha / (1.0 - nh * nh + nh * alpha * nh * alpha);
    float visibility = 0.5 / mix(2.0 * nl * nv, nl + nv, alpha);
    return nl * k * k / 3.14159265 * visibility;
}
