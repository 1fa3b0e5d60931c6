#define M_PI 3.14159265358979323846
#define EIGHT_PI (8.0 * M_PI)
#define NORMALIZATION(n) (((n) + 1.0) / EIGHT_PI)
#define DOT(a, b) max(dot((a), (b)), 0.0)
#define BLINN(N, H, n) pow(DOT(N, H), (n))

float spec(vec3 N, vec3 V, vec3 L, float n)
{
    return NORMALIZATION(n) * BLINN(N, normalize(L + V), n) * DOT(N, L);
}
