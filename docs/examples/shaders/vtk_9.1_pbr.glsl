// VTK's physically based lobe with a Fresnel factor of 1. The distribution squares the roughness, the shadowing does not. N.L has a floor of 1e-5 there.
// Rendering/OpenGL2/glsl/vtkPBRFunctions.glsl, lines 20 to 33 and 42 to 49; N.L: vtkOpenGLPolyDataMapper.cxx, line 1267
// VTK 9.1.0
float highlight(vec3 N, vec3 V, vec3 L, float roughness)
{
    float nl = clamp(dot(N, L), 0.0, 1.0), nv = clamp(dot(N, V), 1e-5, 1.0);
    float nh = clamp(dot(N, normalize(V + L)), 1e-5, 1.0), r2 = roughness * roughness, a2 = r2 * r2;
    float base = (nh * a2 - nh) * nh + 1.0;
    float toEye = nl * sqrt(r2 + nv * (nv - r2 * nv)), toLight = nv * sqrt(r2 + nl * (nl - r2 * nl));
    return a2 / (3.14159265 * base * base) * 0.5 / (toEye + toLight) * nl;
}
