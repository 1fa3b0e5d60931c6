// Shaders with a mistake that somebody has made before, and the names by which it has to be found.
#pragma once

#include <string>
#include <vector>

namespace lobelia {

inline constexpr char kVectors[] = "N,V,L,n";

struct PlantedMistake {
  const char* what;  ///< for the test's messages
  const char* model;
  const char* body;
  std::vector<std::string> mistakes;
  const char* words;  ///< in the sentence
  const char* arguments = kVectors;
  const char* parameters = "vec3 N, vec3 V, vec3 L, float n";
};

inline constexpr char kPlantedPrelude[] = R"(
const float PI = 3.14159265358979;
float half_cosine(vec3 N, vec3 V, vec3 L) { return max(dot(N, normalize(L + V)), 0.0); }
float mirror_cosine(vec3 N, vec3 V, vec3 L) { return max(dot(reflect(-V, N), L), 0.0); }
float to_half(float x) { return unpackHalf2x16(packHalf2x16(vec2(x, 0.0))).x; }
float srgb(float v) { v = clamp(v, 0.0, 1.0); return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1.0 / 2.4) - 0.055; }
)";

inline std::string shader_with(const PlantedMistake& planted) {
  return std::string("#version 420\n") + kPlantedPrelude + "float highlight(" + planted.parameters +
         ")\n{\n" + planted.body + "\n}\n";
}

#define LOBELIA_LIT "float nl = dot(N, L); if (nl <= 0.0) return 0.0; "
inline const std::vector<PlantedMistake>& planted_mistakes() {
  static const std::vector<PlantedMistake> all{
      // The coefficient.
      {"pi is missing",
       "modified_phong",
       LOBELIA_LIT "return (n + 2.0) / 2.0 * pow(mirror_cosine(N, V, L), n) * nl;",
       {"pi-missing"},
       "3.14 times too bright: a division by pi is missing"},
      {"pi is there twice",
       "phong_rdf",
       LOBELIA_LIT "return (n + 1.0) / (2.0 * PI * PI) * pow(mirror_cosine(N, V, L), n);",
       {"pi-twice"},
       "3.14 times too dark: it is divided by pi once too often"},
      {"the 4 of the half-vector is missing",
       "blinn_phong_ndf",
       LOBELIA_LIT "return (n + 1.0) / (2.0 * PI) * pow(half_cosine(N, V, L), n) * nl;",
       {"four-missing"},
       "4 times too bright: the 4 of the half-vector is missing"},
      {"the 4 of the half-vector is there twice",
       "blinn_phong_ndf",
       LOBELIA_LIT "return (n + 1.0) / (32.0 * PI) * pow(half_cosine(N, V, L), n) * nl;",
       {"four-twice"},
       "4 times too dark"},
      {"no coefficient at all",
       "modified_phong",
       LOBELIA_LIT "return pow(mirror_cosine(N, V, L), n) * nl;",
       {"coefficient-missing"},
       "there is no coefficient"},
      {"n + 1 for n + 2",
       "modified_phong",
       LOBELIA_LIT "return (n + 1.0) / (2.0 * PI) * pow(mirror_cosine(N, V, L), n) * nl;",
       {"coefficient"},
       "the coefficient is (n + 1) / (2 pi), where (n + 2) / (2 pi) is expected"},
      {"n + 2 for n + 1",
       "phong_rdf",
       LOBELIA_LIT "return (n + 2.0) / (2.0 * PI) * pow(mirror_cosine(N, V, L), n);",
       {"coefficient"},
       "the coefficient is (n + 2) / (2 pi), where (n + 1) / (2 pi) is expected"},
      {"n + 8 for n + 2",
       "blinn_phong_heightfield",
       LOBELIA_LIT "return (n + 8.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n) * nl;",
       {"coefficient"},
       "the coefficient is (n + 8) / (8 pi), where (n + 2) / (8 pi) is expected"},
      {"no shadowing",
       "microfacet_smith",
       LOBELIA_LIT "return (n + 2.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n) * nl;",
       {"shadowing-missing"},
       "the shadowing is missing"},
      {"n + 8 for the exact form",
       "modified_blinn_phong",
       LOBELIA_LIT "return (n + 8.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n) * nl;",
       {"coefficient"},
       "the coefficient is (n + 8) / (8 pi)"},
      {"a distribution's coefficient for reflected light",
       "modified_blinn_phong",
       LOBELIA_LIT "return (n + 2.0) / (2.0 * PI) * pow(half_cosine(N, V, L), n) * nl;",
       {"coefficient"},
       "the coefficient is (n + 2) / (2 pi)"},
      {"the denominator is missing",
       "blinn_phong_ndf",
       LOBELIA_LIT "return (n + 1.0) * pow(half_cosine(N, V, L), n) * nl;",
       {"eight-pi-missing"},
       "a division by 8 pi is missing"},
      {"the cosine is missing",
       "modified_phong",
       LOBELIA_LIT "return (n + 2.0) / (2.0 * PI) * pow(mirror_cosine(N, V, L), n);",
       {"cosine-missing"},
       "the cosine N.L is missing"},
      {"the cosine is there twice",
       "blinn_phong_ndf",
       LOBELIA_LIT "return (n + 1.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n) * nl * nl;",
       {"cosine-twice"},
       "the cosine N.L is applied twice"},
      {"a cosine in an RDF",
       "blinn_phong_rdf",
       LOBELIA_LIT "return (n + 2.0) / (4.0 * PI * (2.0 - exp2(-0.5 * n))) * "
                   "pow(half_cosine(N, V, L), n) * nl;",
       {"cosine-applied"},
       "which this model does not have"},
      {"the eye's cosine",
       "modified_phong",
       LOBELIA_LIT "return (n + 2.0) / (2.0 * PI) * pow(mirror_cosine(N, V, L), n) * "
                   "max(dot(N, V), 0.0);",
       {"eye-cosine"},
       "N.V is used where the cosine N.L is expected"},
      {"the denominator of a microfacet model",
       "blinn_phong_ndf",
       LOBELIA_LIT "return (n + 1.0) / (2.0 * PI) * pow(half_cosine(N, V, L), n) / "
                   "(4.0 * nl * dot(N, V)) * nl;",
       {"no-geometry-term"},
       "it is divided by (N.L)(N.V)"},
      {"a Fresnel factor",
       "blinn_phong_heightfield",
       LOBELIA_LIT "float vh = dot(V, normalize(L + V)); return (n + 2.0) / (8.0 * PI) * "
                   "pow(half_cosine(N, V, L), n) * nl * (0.04 + 0.96 * pow(1.0 - vh, 5.0));",
       {"fresnel"},
       "a Fresnel factor"},
      // The angle.
      {"H is not normalised",
       "blinn_phong_rdf",
       LOBELIA_LIT "return (n + 2.0) / (4.0 * PI * (2.0 - exp2(-0.5 * n))) * "
                   "pow(max(dot(N, 0.5 * (L + V)), 0.0), n);",
       {"half-vector-halved"},
       "H is (L + V) / 2, which is not normalised"},
      {"H has the wrong sign",
       "blinn_phong_ndf",
       LOBELIA_LIT "return (n + 1.0) / (8.0 * PI) * "
                   "pow(max(dot(N, normalize(L - V)), 0.0), n) * nl;",
       {"half-vector-sign"},
       "one of the directions points the wrong way"},
      {"reflect has the wrong sign",
       "phong_rdf",
       LOBELIA_LIT "return (n + 1.0) / (2.0 * PI) * pow(max(dot(reflect(V, N), L), 0.0), n);",
       {"reflect-sign"},
       "reflect has the wrong sign"},
      {"abs for max",
       "phong_rdf",
       LOBELIA_LIT "return (n + 1.0) / (2.0 * PI) * pow(abs(dot(reflect(-V, N), L)), n);",
       {"abs-mirror"},
       "abs(R.L) is used"},
      {"R.L for N.H",
       "blinn_phong_ndf",
       LOBELIA_LIT "return (n + 1.0) / (8.0 * PI) * pow(mirror_cosine(N, V, L), n) * nl;",
       {"mirror-for-half-vector"},
       "R.L is used where N.H is expected"},
      {"N.H for R.L",
       "modified_phong",
       LOBELIA_LIT "return (n + 2.0) / (2.0 * PI) * pow(half_cosine(N, V, L), n) * nl;",
       {"half-vector-for-mirror"},
       "N.H is used where R.L is expected"},
      {"N.L in the lobe",
       "blinn_phong_ndf",
       LOBELIA_LIT "return (n + 1.0) / (8.0 * PI) * pow(nl, n) * nl;",
       {"light-for-half-vector"},
       "N.L is used in the lobe"},
      {"n for 2 n",
       "modified_phong",
       LOBELIA_LIT "return (n + 2.0) / (2.0 * PI) * pow(mirror_cosine(N, V, L), 0.5 * n) * nl;",
       {"exponent"},
       "n / 2 is used where n is expected"},
      {"4 n, as from Phong to Blinn",
       "blinn_phong_ndf",
       LOBELIA_LIT "n *= 4.0; return (n + 1.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n) * nl;",
       {"exponent"},
       "4 n is used where n is expected"},
      {"alpha is not squared",
       "blinn_phong_heightfield",
       LOBELIA_LIT "float n = 2.0 / alpha - 2.0; return (n + 2.0) / (8.0 * PI) * "
                   "pow(half_cosine(N, V, L), n) * nl;",
       {"exponent-of-roughness"},
       "2 / alpha - 2 (alpha is not squared)",
       "N,V,L,alpha",
       "vec3 N, vec3 V, vec3 L, float alpha"},
      {"alpha is squared twice",
       "blinn_phong_heightfield",
       LOBELIA_LIT "float a = alpha * alpha; float n = 2.0 / (a * a) - 2.0; return (n + 2.0) / "
                   "(8.0 * PI) * pow(half_cosine(N, V, L), n) * nl;",
       {"exponent-of-roughness"},
       "it is squared once too often",
       "N,V,L,alpha",
       "vec3 N, vec3 V, vec3 L, float alpha"},
      {"without the - 2",
       "blinn_phong_heightfield",
       LOBELIA_LIT "float n = 2.0 / pow(roughness, 4.0); return (n + 2.0) / (8.0 * PI) * "
                   "pow(half_cosine(N, V, L), n) * nl;",
       {"exponent-of-roughness"},
       "the exponent is 2 / alpha^2",
       "N,V,L,roughness",
       "vec3 N, vec3 V, vec3 L, float roughness"},
      {"roughness is not squared",
       "modified_phong",
       LOBELIA_LIT "float n = 2.0 / roughness - 2.0; return (n + 2.0) / (2.0 * PI) * "
                   "pow(mirror_cosine(N, V, L), n) * nl;",
       {"exponent-of-roughness"},
       "roughness is not squared at all",
       "N,V,L,roughness",
       "vec3 N, vec3 V, vec3 L, float roughness"},
      {"a gloss of 2^(10 g + 1)",
       "modified_phong",
       LOBELIA_LIT "float n = exp2(10.0 * (1.0 - roughness) + 1.0); return (n + 2.0) / (2.0 * PI) "
                   "* pow(mirror_cosine(N, V, L), n) * nl;",
       {"exponent-of-roughness"},
       "2^(10 (1 - roughness) + 1)",
       "N,V,L,roughness",
       "vec3 N, vec3 V, vec3 L, float roughness"},
      {"half-float s",
       "modified_phong",
       "if (nl <= 0.0) return 0.0; return (n + 2.0) / (2.0 * PI) * "
       "pow(max(1.0 - to_half(s), 0.0), n) * nl;",
       {"half-float-s"},
       "s is a half float",
       "N.L,s,n",
       "float nl, float s, float n"},
      {"half-float cosine",
       "modified_phong",
       "if (nl <= 0.0) return 0.0; return (n + 2.0) / (2.0 * PI) * "
       "pow(max(to_half(c), 0.0), n) * nl;",
       {"half-float-cosine"},
       "the cosine of the lobe is a half float",
       "N.L,cosine,n",
       "float nl, float c, float n"},
      {"clamped",
       "modified_phong",
       LOBELIA_LIT "return min((n + 2.0) / (2.0 * PI) * pow(mirror_cosine(N, V, L), n) * nl, 1.0);",
       {"clamped"},
       "the result is clamped to 1"},
      {"sRGB",
       "modified_phong",
       LOBELIA_LIT "return srgb((n + 2.0) / (2.0 * PI) * pow(mirror_cosine(N, V, L), n) * nl);",
       {"srgb"},
       "encoded as sRGB, where light is expected"},
      {"sRGB twice",
       "modified_phong",
       LOBELIA_LIT
       "return srgb(srgb((n + 2.0) / (2.0 * PI) * pow(mirror_cosine(N, V, L), n) * nl));",
       {"srgb-twice"},
       "encoded as sRGB twice"},
      {"a gamma",
       "blinn_phong_ndf",
       LOBELIA_LIT "return pow((n + 1.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n) * nl, "
                   "1.0 / 2.2);",
       {"gamma"},
       "a gamma of 1 / 2.2"},
      {"light from behind",
       "blinn_phong_rdf",
       "return (n + 2.0) / (4.0 * PI * (2.0 - exp2(-0.5 * n))) * pow(half_cosine(N, V, L), n);",
       {"light-behind"},
       "light leaks through from behind"},
      {"abs of the cosine",
       "blinn_phong_ndf",
       "return (n + 1.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n) * abs(dot(N, L));",
       {"abs-cosine"},
       "abs(N.L) is used"},
      {"another lobe",
       "modified_phong",
       LOBELIA_LIT "float s = 1.0 - mirror_cosine(N, V, L); if (s >= 1.0) return 0.0; "
                   "return (n + 2.0) / (2.0 * PI) * exp(-n * s) * nl;",
       {"lobe"},
       "its lobe is spherical_gaussian"},
      // Two at a time.
      {"no pi, and the cosine twice",
       "modified_phong",
       LOBELIA_LIT "return (n + 2.0) / 2.0 * pow(mirror_cosine(N, V, L), n) * nl * nl;",
       {"pi-missing", "cosine-twice"},
       "a division by pi is missing; the cosine N.L"},
      {"n + 8, and no cosine",
       "blinn_phong_ndf",
       LOBELIA_LIT "return (n + 8.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n);",
       {"coefficient", "cosine-missing"},
       "the coefficient is (n + 8) / (8 pi)"},
      {"no cosine, and light from behind",
       "blinn_phong_ndf",
       "return (n + 1.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n);",
       {"cosine-missing", "light-behind"},
       "light leaks"},
  };
  return all;
}
#undef LOBELIA_LIT

}  // namespace lobelia
