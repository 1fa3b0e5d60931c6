// What the exported functions compute in float32, against the renderer in float64.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/fresnel.hpp"
#include "shaders/export.hpp"
#include "tests/shaders/directions.hpp"
#include "tests/shaders/exports.hpp"
#include "tests/shaders/shader_functions.hpp"

namespace lobelia {
namespace {

using shader_functions::ShaderFunction;
using shader_functions::vec3;

std::vector<const ShaderFunction*> all_functions() {
  std::vector<const ShaderFunction*> all;
  for (const auto* table : {&shader_functions::glsl::table(), &shader_functions::hlsl::table(),
                            &shader_functions::msl::table(), &shader_functions::osl::table()})
    for (const ShaderFunction& function : *table) all.push_back(&function);
  return all;
}

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

constexpr Rgb kReflectance{0.04, 0.5, 1};

/// With the highlight's coefficient as the argument.
Rgb value(const ShaderFunction& function, const Highlight& highlight, double coefficient,
          const Directions& d) {
  const vec3 radiance = function.radiance(rounded(d.normal), rounded(d.to_eye), rounded(d.to_light),
                                          highlight.exponent, coefficient,
                                          {kReflectance.r, kReflectance.g, kReflectance.b});
  return {radiance.x.value, radiance.y.value, radiance.z.value};
}

double largest_difference(Rgb a, Rgb b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

Rgb fresnel_of(const ShaderFunction& function, const Directions& d) {
  return function.has_fresnel
             ? fresnel_factor(Fresnel::kSchlick, kReflectance, d.to_eye, d.to_light)
             : Rgb{1, 1, 1};
}

TEST(ExportedFunction, HasTheRadianceOfTheRendererInEveryDirection) {
  // Measured, of the peak: 3.4e-6 up to n = 1024 and 3.2e-5 at 1e5; where light and eye are nearly
  // opposite, 5.0e-5 and 7.3e-4. The unit vectors' rounding, so the same for all lobes but cs64 at n = 1.
  int cases = 0;
  for (const ShaderFunction* function : all_functions())
    for (const double n : kFixedExponents) {
      Highlight highlight = function->highlight;
      if (function->is_fixed && n != highlight.exponent) continue;
      highlight.exponent = n;
      RandomDirections random(n);
      Tolerance tolerance(highlight);
      const double peak = radiance_coefficient(highlight);
      double worst = 0;  // in tolerances
      for (int i = 0; i < 2000; ++i) {
        const Directions d = random();
        const Rgb ours = value(*function, highlight, peak, d);
        ASSERT_TRUE(ours.r >= 0 && ours.g >= 0 && ours.b >= 0) << function->name;
        const Rgb expected = truth(highlight, peak, d) * fresnel_of(*function, d);
        const double error = largest_difference(ours, expected) / peak;
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

bool is_number(Rgb c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }

TEST(ExportedFunction, IsZeroBelowTheHorizonAndANumberEverywhere) {
  const Vec3 normal{0, 0, 1}, low = normalize({0.6, 0.3, -0.01}), high{0.6, 0, 0.8};
  for (const ShaderFunction* function : all_functions()) {
    Highlight highlight = function->highlight;
    for (const double n : {0.0, 3.0, kMaxExponent}) {
      if (!function->is_fixed) highlight.exponent = n;
      const auto at = [&](Directions d) { return value(*function, highlight, 1, d); };
      EXPECT_TRUE(is_black(at({normal, high, low}))) << function->name;
      EXPECT_TRUE(is_black(at({normal, high, {1, 0, 0}}))) << function->name;
      // Light and eye face each other: they have no half vector.
      EXPECT_TRUE(is_number(at({normal, -high, high}))) << function->name;
      EXPECT_TRUE(is_number(at({normal, {-1, 0, 0}, {1, 0, 0}}))) << function->name;
      EXPECT_TRUE(is_number(at({normal, normal, normal}))) << function->name;
      EXPECT_TRUE(is_number(at({normal, high, high}))) << function->name;
      if (function->coefficient) {
        EXPECT_TRUE(std::isfinite(function->coefficient(n).value)) << function->name;
      }
    }
  }
}

}  // namespace
}  // namespace lobelia
