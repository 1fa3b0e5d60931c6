// BSDFs as people write them, and mistakes planted in them.
#pragma once

#include <string>
#include <vector>

namespace lobelia {

/// A cosine-power lobe around the mirror direction; world frame, eval without the cosine.
inline constexpr char kPhongBsdf[] = R"(
const float PI = 3.14159265358979;
void frame(vec3 w, out vec3 a, out vec3 b)
{
    a = normalize(abs(w.z) < 0.9 ? cross(w, vec3(0.0, 0.0, 1.0)) : cross(w, vec3(1.0, 0.0, 0.0)));
    b = cross(w, a);
}
vec3 phongEval(vec3 N, vec3 V, vec3 L, float n)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    return vec3((n + 2.0) / (2.0 * PI) * pow(max(dot(reflect(-V, N), L), 0.0), n));
}
float phongPdf(vec3 N, vec3 V, vec3 L, float n)
{
    return (n + 1.0) / (2.0 * PI) * pow(max(dot(reflect(-V, N), L), 0.0), n);
}
vec3 phongSample(vec3 N, vec3 V, vec2 u, float n, out vec3 weight, out float pdf)
{
    vec3 R = reflect(-V, N), a, b;
    frame(R, a, b);
    float c = pow(u.x, 1.0 / (n + 1.0)), s = sqrt(max(0.0, 1.0 - c * c)), t = 2.0 * PI * u.y;
    vec3 L = normalize(s * cos(t) * a + s * sin(t) * b + c * R);
    pdf = phongPdf(N, V, L, n);
    weight = pdf > 0.0 ? phongEval(N, V, L, n) * max(dot(N, L), 0.0) / pdf : vec3(0.0);
    return L;
}
)";

/// Half vectors by a cosine power; local frame, the eye's direction is named wi, eval with the cosine, a structure.
inline constexpr char kBlinnBsdf[] = R"(
float D(float c, float n) { return (n + 2.0) / 6.28318531 * pow(max(c, 0.0), n); }
float eval(vec3 wi, vec3 wo, float n)
{
    if (wi.z <= 0.0 || wo.z <= 0.0) return 0.0;
    return D(normalize(wi + wo).z, n) / 4.0 * wo.z;
}
float pdf(vec3 wi, vec3 wo, float n)
{
    if (wi.z <= 0.0 || wo.z <= 0.0) return 0.0;
    vec3 h = normalize(wi + wo);
    return D(h.z, n) * h.z / (4.0 * dot(wi, h));
}
struct Sample { vec3 wo; float pdf, weight; bool ok; };
Sample sample_bsdf(vec3 wi, float n, vec2 u)
{
    Sample s;
    float c = pow(u.x, 1.0 / (n + 2.0)), r = sqrt(max(0.0, 1.0 - c * c)), t = 6.28318531 * u.y;
    vec3 h = vec3(r * cos(t), r * sin(t), c);
    s.wo = reflect(-wi, h);
    s.pdf = pdf(wi, s.wo, n);
    s.ok = dot(wi, h) > 0.0 && s.wo.z > 0.0;
    s.weight = s.pdf > 0.0 ? eval(wi, s.wo, n) / s.pdf : 0.0;
    return s;
}
)";

/// GGX, with visible normals; local frame, eval without the cosine, a direction with its pdf as four numbers.
inline constexpr char kGgxBsdf[] = R"(
const float PI = 3.14159265358979;
float D(vec3 h, float a)
{
    float a2 = a * a, c = dot(h.xy, h.xy) / a2 + h.z * h.z;
    return h.z <= 0.0 ? 0.0 : 1.0 / (PI * a2 * c * c);
}
float lambda(vec3 v, float a)
{
    return 0.5 * (sqrt(1.0 + a * a * dot(v.xy, v.xy) / (v.z * v.z)) - 1.0);
}
float ggx_eval(vec3 V, vec3 L, float alpha)
{
    if (V.z <= 0.0 || L.z <= 0.0) return 0.0;
    return D(normalize(V + L), alpha) / (1.0 + lambda(V, alpha) + lambda(L, alpha)) / (4.0 * V.z * L.z);
}
float ggx_pdf(vec3 V, vec3 L, float alpha)
{
    if (V.z <= 0.0 || L.z <= 0.0) return 0.0;
    vec3 h = normalize(V + L);
    return D(h, alpha) / (1.0 + lambda(V, alpha)) / (4.0 * V.z);
}
vec3 half_vector(vec3 V, float alpha, float u1, float u2)
{
    vec3 Vh = normalize(vec3(alpha * V.xy, V.z));
    float len = length(Vh.xy);
    vec3 a = len > 0.0 ? vec3(-Vh.y, Vh.x, 0.0) / len : vec3(1.0, 0.0, 0.0), b = cross(Vh, a);
    float r = sqrt(u1), t = 2.0 * PI * u2, x = r * cos(t), y = r * sin(t), s = 0.5 * (1.0 + Vh.z);
    y = (1.0 - s) * sqrt(max(0.0, 1.0 - x * x)) + s * y;
    vec3 Nh = x * a + y * b + sqrt(max(0.0, 1.0 - x * x - y * y)) * Vh;
    return normalize(vec3(alpha * Nh.xy, max(1e-6, Nh.z)));
}
vec4 ggx_sample(vec3 V, float alpha, float u1, float u2)
{
    vec3 L = reflect(-V, half_vector(V, alpha, u1, u2));
    return vec4(L, ggx_pdf(V, L, alpha));
}
)";

/// Without any parameter.
inline constexpr char kDiffuseBsdf[] = R"(
float eval(vec3 V, vec3 L) { return V.z > 0.0 && L.z > 0.0 ? 0.318309886 : 0.0; }
float pdf(vec3 V, vec3 L) { return max(L.z, 0.0) * 0.318309886; }
vec3 sampled(vec3 V, float u1, float u2)
{
    float r = sqrt(u1), t = 6.28318531 * u2;
    return vec3(r * cos(t), r * sin(t), sqrt(1.0 - u1));
}
)";

struct PlantedBsdf {
  const char *what, *shader, *right, *wrong;
  std::vector<std::string> mistakes;  ///< that are named; empty: it fails, and nothing is proved
  std::string check;                  ///< a test that fails
};

inline std::vector<PlantedBsdf> planted_bsdfs() {
  return {
      {"a constant factor",
       kPhongBsdf,
       "(n + 1.0) / (2.0 * PI) *",
       "(n + 1.0) / PI *",
       {"pdf-factor"},
       "pdf-integral"},
      {"the coefficient of eval",
       kPhongBsdf,
       "(n + 1.0) / (2.0 * PI) *",
       "(n + 2.0) / (2.0 * PI) *",
       {"pdf-factor"},
       "pdf-integral"},
      {"half of pdf",
       kPhongBsdf,
       "(n + 1.0) / (2.0 * PI) *",
       "(n + 1.0) / (4.0 * PI) *",
       {"pdf-factor"},
       "samples-lost"},
      {"no cosine in the weight",
       kPhongBsdf,
       "* max(dot(N, L), 0.0) / pdf",
       "/ pdf",
       {"weight-cosine-missing"},
       "weight"},
      {"a weight not divided",
       kPhongBsdf,
       "/ pdf : vec3",
       ": vec3",
       {"weight-without-pdf"},
       "weight"},
      {"eval as the weight",
       kPhongBsdf,
       "* max(dot(N, L), 0.0) / pdf",
       "",
       {"weight-is-eval"},
       "weight"},
      {"a closed weight below the surface",
       kPhongBsdf,
       "pdf > 0.0 ? phongEval(N, V, L, n) * max(dot(N, L), 0.0) / pdf : vec3(0.0)",
       "vec3((n + 2.0) / (n + 1.0) * abs(dot(N, L)))",
       {"weight-below"},
       "weight"},
      {"one random number twice",
       kPhongBsdf,
       "2.0 * PI * u.y",
       "2.0 * PI * u.x",
       {"random-number-unused"},
       "random-numbers"},
      {"twice the exponent",
       kPhongBsdf,
       "1.0 / (n + 1.0)",
       "1.0 / (2.0 * n + 1.0)",
       {"pdf-other-parameter"},
       "chi-square"},
      {"too bright", kPhongBsdf, "(n + 2.0) / (2.0 * PI)", "(n + 8.0) / (2.0 * PI)", {}, "energy"},
      {"no Jacobian",
       kBlinnBsdf,
       "* h.z / (4.0 * dot(wi, h))",
       "* h.z",
       {"half-vector-jacobian"},
       "chi-square"},
      {"the Jacobian without its 4",
       kBlinnBsdf,
       "(4.0 * dot(wi, h))",
       "dot(wi, h)",
       {"pdf-factor"},
       "pdf-integral"},
      {"the Jacobian twice",
       kBlinnBsdf,
       "(4.0 * dot(wi, h))",
       "(16.0 * dot(wi, h) * dot(wi, h))",
       {"half-vector-jacobian-twice"},
       "chi-square"},
      {"no N.H",
       kBlinnBsdf,
       "* h.z / (4.0",
       "/ (4.0",
       {"pdf-half-vector-cosine-missing"},
       "chi-square"},
      {"another pdf by sample",
       kBlinnBsdf,
       "s.pdf = pdf(wi, s.wo, n)",
       "s.pdf = 2.0 * pdf(wi, s.wo, n)",
       {"given-pdf", "weight-factor"},
       "pdf-of-sample"},
      {"the cosine twice in the weight",
       kBlinnBsdf,
       "eval(wi, s.wo, n) / s.pdf",
       "eval(wi, s.wo, n) * s.wo.z / s.pdf",
       {"weight-cosine-twice"},
       "weight"},
      {"visible normals with another pdf",
       kGgxBsdf,
       "D(h, alpha) / (1.0 + lambda(V, alpha)) / (4.0 * V.z)",
       "D(h, alpha) * h.z / (4.0 * dot(V, h))",
       {"visible-normals-sampled"},
       "chi-square"},
      {"roughness for alpha",
       kGgxBsdf,
       "    vec3 h = normalize(V + L);\n",
       "    vec3 h = normalize(V + L);\n    alpha = sqrt(alpha);\n",
       {"pdf-other-parameter"},
       "chi-square"},
      {"alpha squared",
       kGgxBsdf,
       "    vec3 h = normalize(V + L);\n",
       "    vec3 h = normalize(V + L);\n    alpha *= alpha;\n",
       {"pdf-other-parameter"},
       "chi-square"},
      {"no guards in eval",
       kGgxBsdf,
       "if (V.z <= 0.0 || L.z <= 0.0) return 0.0;\n    return",
       "return",
       {},
       "finite"},
      {"a pdf with a hole",
       kGgxBsdf,
       "|| L.z <= 0.0) return 0.0;\n    vec3",
       "|| L.z <= 0.3) return 0.0;\n    vec3",
       {},
       "pdf-at-samples"},
      {"no cosine in pdf",
       kDiffuseBsdf,
       "max(L.z, 0.0) * 0.318309886",
       "L.z > 0.0 ? 0.318309886 : 0.0",
       {"pdf-cosine-missing"},
       "pdf-integral"},
      {"an even pdf",
       kDiffuseBsdf,
       "max(L.z, 0.0) * 0.318309886",
       "L.z > 0.0 ? 0.159154943 : 0.0",
       {"pdf-cosine-missing", "pdf-factor"},
       "chi-square"},
      {"the whole sphere",
       kDiffuseBsdf,
       "sqrt(1.0 - u1)",
       "(fract(u1 * 4096.0) < 0.5 ? -1.0 : 1.0) * sqrt(1.0 - u1)",
       {"hemisphere-not-rejected"},
       "samples-lost"},
      {"no unit vector", kDiffuseBsdf, "sqrt(1.0 - u1)", "1.0", {}, "unit-direction"},
  };
}

}  // namespace lobelia
