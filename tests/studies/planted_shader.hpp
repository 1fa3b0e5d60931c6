// A shader with a planted mistake, and what it is to be found by.
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
float aces(float v) { return min(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 1.0); }
float alpha2(float n) { return 2.0 / (n + 2.0); }
float smith_g1(float c, float n) { return 2.0 / (c + sqrt(alpha2(n) + (1.0 - alpha2(n)) * c * c)); }
float schlick_g1(float c, float k) { return 1.0 / (c * (1.0 - k) + k); }
float direct_k(float n) { float r = sqrt(sqrt(alpha2(n))) + 1.0; return r * r / 8.0; }
)";

inline std::string shader_with(const PlantedMistake& planted) {
  return std::string("#version 420\n") + kPlantedPrelude + "float highlight(" + planted.parameters +
         ")\n{\n" + planted.body + "\n}\n";
}

}  // namespace lobelia
