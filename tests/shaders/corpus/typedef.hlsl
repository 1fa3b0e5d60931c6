typedef float3 Vec;
typedef float Real;
Real spec(Vec N, Vec V, Vec L, Real n) { return (n + 2) / 6.283185307 * pow(max(dot(reflect(-V, N), L), 0), n) * max(dot(N, L), 0); }
