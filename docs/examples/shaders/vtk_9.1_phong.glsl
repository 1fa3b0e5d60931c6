// VTK's Phong for a light that is not the headlight. n is the specular power.
// Rendering/OpenGL2/vtkOpenGLPolyDataMapper.cxx, lines 1279 to 1285
// VTK 9.1.0
float highlight(vec3 N, vec3 V, vec3 L, float n)
{
    return sign(max(0.0, dot(N, L))) * pow(max(0.0, dot(reflect(-L, N), V)), n);
}
