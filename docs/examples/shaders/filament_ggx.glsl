// Filament's isotropic lobe with a Fresnel factor of 1: GGX with the height-correlated Smith term, for half floats.
// shaders/src/surface_brdf.fs, lines 54 to 79 and 102 to 113; N.L: surface_shading_model_standard.fs, surfaceShading
// Filament, commit 04d50d42
float highlight(vec3 N, vec3 V, vec3 L, float alpha)
{
    float nl = clamp(dot(N, L), 0.0, 1.0), nv = max(dot(N, V), 1e-4);
    float nh = clamp(dot(N, normalize(V + L)), 0.0, 1.0), a2 = alpha * alpha;
    float k = min(alpha / (1.0 - nh * nh + nh * alpha * nh * alpha), 453.5);
    float toEye = nl * sqrt((nv - a2 * nv) * nv + a2), toLight = nv * sqrt((nl - a2 * nl) * nl + a2);
    return k * k / 3.14159265 * 0.5 / max(toEye + toLight, 7.7e-6) * nl;
}
