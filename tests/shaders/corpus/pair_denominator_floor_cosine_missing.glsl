float G1(float c, float k) { return c / (c * (1.0 - k) + k); }
float S1(float c, float a) { return 2.0 * c / (c + sqrt(a * a + (1.0 - a * a) * c * c)); }

#define PI 3.14159265358979
float D(float nh, float a) { float a2 = a * a; float d = nh * nh * (a2 - 1.0) + 1.0; return a2 / (PI * d * d); }

float Vis(float nl, float nv, float a) { float a2 = a * a; return 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2)); }
float spec(vec3 N, vec3 V, vec3 L, float roughness) {
    vec3 H = normalize(V + L); float a = roughness * roughness;
    float nl = dot(N, L), nv = dot(N, V), nh = max(dot(N, H), 0.0), vh = max(dot(V, H), 0.0);
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    return D(nh, a) * (Vis(nl, nv, a) * 4.0 * nl * nv) / max(4.0 * nl * nv, 0.02);
}
