// What the exported functions compute in float32, against the renderer in float64.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/vec.hpp"
#include "renderer/precision.hpp"
#include "shaders/export.hpp"
#include "tests/shaders/exports.hpp"
#include "tests/shaders/shader_functions.hpp"

namespace lobelia {
namespace {

using shader_functions::ShaderFunction;
using shader_functions::vec3;

std::vector<const ShaderFunction*> all_functions() {
  std::vector<const ShaderFunction*> all;
  for (const auto* table : {&shader_functions::glsl::table(), &shader_functions::osl::table()})
    for (const ShaderFunction& function : *table) all.push_back(&function);
  return all;
}

struct Directions {
  Vec3 normal, to_eye, to_light;
};

/// Eye and light above the horizon; half of them where the highlight is, some grazing.
class RandomDirections {
 public:
  explicit RandomDirections(const Highlight& highlight) : highlight_(highlight) {}
  Directions operator()() {
    Directions d{direction(), {}, {}};
    const double grazing = uniform_(random_) < 0.2 ? 1e-3 : 1;
    d.to_eye = above(d.normal, grazing);
    d.to_light = above(d.normal, grazing);
    if (uniform_(random_) < 0.5) {
      const double width = 2 / std::sqrt(highlight_.exponent);
      const Vec3 mirrored = 2 * dot(d.normal, d.to_eye) * d.normal - d.to_eye;
      const Vec3 nearby = normalize(mirrored + width * uniform_(random_) * direction());
      if (dot(nearby, d.normal) > 0) d.to_light = nearby;
    }
    return d;
  }

 private:
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return normalize({normal(random_), normal(random_), normal(random_)});
  }
  Vec3 above(Vec3 normal, double most) {
    const double height = most * (1e-6 + (1 - 1e-6) * uniform_(random_));
    const Vec3 any = direction(), across = normalize(any - dot(any, normal) * normal);
    return height * normal + std::sqrt(1 - height * height) * across;
  }
  const Highlight& highlight_;
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> uniform_;
};

vec3 rounded(Vec3 v) { return {v.x, v.y, v.z}; }

/// highlight_radiance, whose coefficient need not be computed for every direction.
double truth(const Highlight& highlight, double coefficient, const Directions& d) {
  const Vec3 difference = info(highlight.model).angle == LobeAngle::kReflection
                              ? 2 * dot(d.normal, d.to_eye) * d.normal - d.to_eye - d.to_light
                              : d.normal - normalize(d.to_eye + d.to_light);
  return coefficient *
         lobe_value(highlight.lobe, 0.5 * dot(difference, difference), highlight.exponent) *
         foreshortening(highlight.model, dot(d.normal, d.to_light));
}

float value(const ShaderFunction& function, const Highlight& highlight, const Directions& d) {
  const vec3 n = rounded(d.normal), v = rounded(d.to_eye), l = rounded(d.to_light);
  return function.fixed ? function.fixed(n, v, l).value
                        : function.of_exponent(n, v, l, highlight.exponent).value;
}

/// Of the peak: what the renderer's own float32 may be off by (docs/numerics.md), which depends on the
/// length of L + V, and the coefficient's error.
class Tolerance {
 public:
  explicit Tolerance(const Highlight& highlight) : highlight_(highlight) {}
  double at(const Directions& d) {
    const double half_length = length(d.to_eye + d.to_light);
    const int power = std::clamp(int(std::floor(std::log2(half_length))), -30, 1);
    const auto [entry, is_new] = of_power_.try_emplace(power, 0);
    if (is_new)
      entry->second = 3e-6 + shading_error_bound(Precision::kFloat32, highlight_, std::exp2(power));
    return entry->second;
  }

 private:
  Highlight highlight_;
  std::map<int, double> of_power_;
};

TEST(ExportedFunction, HasTheRadianceOfTheRendererInEveryDirection) {
  // Measured, of the peak: 3.4e-6 up to n = 1024 and 3.2e-5 at 1e5; where light and eye are nearly
  // opposite, 5.0e-5 and 7.3e-4. The unit vectors' rounding, so the same for all lobes but cs64 at n = 1.
  int cases = 0;
  for (const ShaderFunction* function : all_functions())
    for (const double n : kFixedExponents) {
      Highlight highlight = function->highlight;
      if (function->fixed && n != highlight.exponent) continue;
      highlight.exponent = n;
      RandomDirections random(highlight);
      Tolerance tolerance(highlight);
      const double peak = radiance_coefficient(highlight);
      double worst = 0;  // in tolerances
      for (int i = 0; i < 2000; ++i) {
        const Directions d = random();
        const float ours = value(*function, highlight, d);
        ASSERT_TRUE(ours >= 0) << function->name;
        const double error = std::abs(ours - truth(highlight, peak, d)) / peak;
        worst = std::max(worst, error / tolerance.at(d));
      }
      EXPECT_LE(worst, 1) << function->name << " n = " << n;
      ++cases;
    }
  EXPECT_GE(cases, 1000);
}

TEST(ExportedFunction, HasTheCoefficientOfTheRendererForEveryExponent) {
  int functions = 0;
  for (const ShaderFunction* function : all_functions()) {
    if (!function->coefficient) continue;
    ++functions;
    Highlight highlight = function->highlight;
    double worst = 0;
    for (double n = kMinExponent; n <= kMaxExponent; n *= 1.1) {
      highlight.exponent = double(float(n));
      const double coefficient = function->coefficient(highlight.exponent).value;
      worst = std::max(worst, std::abs(coefficient / radiance_coefficient(highlight) - 1));
    }
    // Measured: 3e-7, and for cs_k 2e-8 k.
    EXPECT_LE(worst, 3e-6) << function->name;
  }
  EXPECT_GE(functions, 100);
}

TEST(ExportedFunction, IsZeroBelowTheHorizonAndANumberEverywhere) {
  const Vec3 normal{0, 0, 1}, low = normalize({0.6, 0.3, -0.01}), high{0.6, 0, 0.8};
  for (const ShaderFunction* function : all_functions()) {
    Highlight highlight = function->highlight;
    if (!function->fixed) highlight.exponent = 3;
    EXPECT_EQ(value(*function, highlight, {normal, high, low}), 0) << function->name;
    EXPECT_EQ(value(*function, highlight, {normal, high, {1, 0, 0}}), 0) << function->name;
    // Light and eye face each other: they have no half vector.
    EXPECT_TRUE(std::isfinite(value(*function, highlight, {normal, -high, high})));
    EXPECT_TRUE(std::isfinite(value(*function, highlight, {normal, {-1, 0, 0}, {1, 0, 0}})));
  }
}

}  // namespace
}  // namespace lobelia
