// Babylon.js' StandardMaterial: no coefficient, no N.L and no test of the side of the light. n is specularPower.
// npm @babylonjs/core: Shaders/ShadersInclude/lightsFragmentFunctions.js, line 32
// Babylon.js 9.35.0
float highlight(vec3 N, vec3 V, vec3 L, float n)
{
    return pow(max(0.0, dot(N, normalize(V + L))), max(1.0, n));
}
