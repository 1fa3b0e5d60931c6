// OGRE's lighting for each pixel, where "normalised" is set. It clamps the sum to 1 afterwards, which is left out here.
// Media/RTShaderLib/GLSL/SGXLib_PerPixelLighting.glsl, lines 79 to 85
// OGRE 1.12.10
float highlight(vec3 N, vec3 V, vec3 L, float n)
{
    if (dot(N, L) <= 0.0) return 0.0;
    return (n + 8.0) / (8.0 * 3.141592654) * pow(clamp(dot(N, normalize(V + L)), 0.0, 1.0), n);
}
