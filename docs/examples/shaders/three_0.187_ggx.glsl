// three.js' MeshStandardMaterial with a Fresnel factor of 1: GGX with the height-correlated Smith term.
// src/renderers/shaders/ShaderChunk/lights_physical_pars_fragment.glsl.js, lines 145 to 166
// three.js 0.187.0
float highlight(vec3 N, vec3 V, vec3 L, float alpha)
{
    float nl = clamp(dot(N, L), 0.0, 1.0), nv = clamp(dot(N, V), 0.0, 1.0);
    float nh = clamp(dot(N, normalize(L + V)), 0.0, 1.0), a2 = alpha * alpha;
    float base = nh * nh * (a2 - 1.0) + 1.0;
    float toEye = nl * sqrt(a2 + (1.0 - a2) * nv * nv), toLight = nv * sqrt(a2 + (1.0 - a2) * nl * nl);
    return a2 / (3.14159265 * base * base) * 0.5 / max(toEye + toLight, 1e-6) * nl;
}
