#define USE_BLINN 1
#if USE_BLINN
float lobe(vec3 N, vec3 V, vec3 L, float n) { return pow(max(dot(N, normalize(L + V)), 0.0), n); }
#else
float lobe(vec3 N, vec3 V, vec3 L, float n) { return pow(max(dot(reflect(-L, N), V), 0.0), n); }
#endif
#ifdef UNDEFINED_THING
this is no GLSL {
#endif
float specularTerm(vec3 N, vec3 V, vec3 L, float n)
{
    return (n + 1.0) / (8.0 * 3.14159265) * lobe(N, V, L, n) * max(dot(N, L), 0.0);
}
