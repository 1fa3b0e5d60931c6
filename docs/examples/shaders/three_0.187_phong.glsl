// three.js' MeshPhongMaterial with a white specular colour, for which its Fresnel factor is 1. n is shininess.
// src/renderers/shaders/ShaderChunk/bsdfs.glsl.js, lines 3 to 29; N.L: lights_phong_pars_fragment.glsl.js, line 16
// three.js 0.187.0
float highlight(vec3 N, vec3 V, vec3 L, float n)
{
    float D = (0.5 * n + 1.0) / 3.14159265 * pow(clamp(dot(N, normalize(L + V)), 0.0, 1.0), n);
    return 0.25 * D * clamp(dot(N, L), 0.0, 1.0);
}
