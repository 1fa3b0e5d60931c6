// PlayCanvas' StandardMaterial without GGX. A material has n = 2^(11 gloss). Its Lambert surface has no 1 / pi either.
// npm playcanvas: src/scene/shader-lib/glsl/chunks/lit/frag/lightSpecularBlinn.js, lines 2 to 7, lighting/lightFunctionLight.js, lines 82 and 155
// PlayCanvas 2.23.3
float highlight(vec3 N, vec3 V, vec3 L, float n)
{
    float lobe = pow(max(dot(normalize(V + L), N), 0.0), n);
    return lobe * (n + 2.0) / 8.0 * max(dot(N, L), 0.0);
}
