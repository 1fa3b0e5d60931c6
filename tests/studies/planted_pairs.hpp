// Shaders with two mistakes, and the names by which they have to be found.
#pragma once

#include "tests/studies/planted_shader.hpp"

namespace lobelia {

#define LOBELIA_LIT "float nl = dot(N, L); if (nl <= 0.0) return 0.0; "
inline std::vector<PlantedMistake> planted_pairs() {
  return {
      {"128 n without a coefficient",
       "modified_blinn_phong",
       LOBELIA_LIT "return pow(half_cosine(N, V, L), 128.0 * n) * nl;",
       {"coefficient-missing", "exponent"},
       "128 n is used"},
      {"4 times, and a floor",
       "blinn_phong_heightfield",
       "return (n + 2.0) / (2.0 * PI) * pow(max(dot(N, normalize(L + V)), 0.0001), n) * max(dot(N, L), 0.0001);",
       {"four-missing", "floor"},
       "4 times too bright"},
      {"L is reversed, and 4 times",
       "blinn_phong_heightfield",
       "L = -L; return 4.0 * (n + 2.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n) * max(dot(N, L), 0.0);",
       {"four-missing", "light-reversed"},
       "L is reversed"},
      {"no max, and 2 times",
       "modified_phong",
       "return (n + 2.0) / PI * pow(dot(reflect(-L, N), V), n) * max(dot(N, L), 0.0);",
       {"two-missing", "negative-base"},
       "NaN at"},
      {"ambient and diffuse",
       "modified_phong",
       "return 0.1 + (0.5 + (n + 2.0) / (2.0 * PI) * pow(mirror_cosine(N, V, L), n)) * max(dot(N, L), 0.0);",
       {"ambient", "diffuse"},
       "0.1 + 0.5 N.L is on top"},
      {"no cosine, and a Fresnel factor",
       "blinn_phong_heightfield",
       LOBELIA_LIT
       "float vh = dot(V, normalize(L + V)); return (n + 2.0) / (8.0 * PI) * pow(half_cosine(N, V, L), n) * (0.2 + 0.8 * pow(1.0 - vh, 5.0));",
       {"cosine-missing", "fresnel"},
       "F0 = 0.2"},
  };
}
#undef LOBELIA_LIT

}  // namespace lobelia
