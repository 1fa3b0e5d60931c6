#include <algorithm>
#include <cmath>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/reflector.hpp"
#include "studies/stability/cases.hpp"
#include "studies/stability/naive.hpp"
#include "studies/stability/vectors.hpp"

namespace lobelia::stability {
namespace {

struct Case {
  std::string name;
  Triple at;
};

/// A unit vector, to a rounding, with a float32 dot product with itself above 1.
Vec3 longer_than_one() {
  RandomVectors vectors(LobeAngle::kReflection, 1, 2);
  for (;;) {
    const Vec3 v = vectors.next().normal;
    const float x = float(v.x), y = float(v.y), z = float(v.z);
    if (x * x + y * y + z * z > 1) return v;
  }
}

std::vector<Case> cases(double n) {
  const Vec3 long_one = longer_than_one();
  const double flank = 1 / std::sqrt(n);
  // (2, 13, 31) is the mirror direction of (2, 3, 1) about (1, 2, 2), exactly.
  const Vec3 normal{1, 2, 2}, eye{2, 3, 1}, mirror{2, 13, 31};
  const Vec3 beside = mirror + flank * length(mirror) * Vec3{0.8, 0.6, 0};
  const auto scaled = [&](double k) { return Triple{k * normal, k * eye, k * beside}; };
  const auto at_horizon = [](double l) { return Triple{{0, 0, 1}, {-0.6, 0, 0.8}, {1, 0, l}}; };
  const auto eye_at = [](double v) { return Triple{{0, 0, 1}, {-1, 0, v}, {0.6, 0, 0.8}}; };
  const auto mirrored = [](double z) { return Triple{{0, 0, 1}, {-1, 0, z}, {1, 0, z}}; };
  constexpr double kUlp = 0x1p-149;  // the next float32 to 0
  return {
      {"mirror direction, oblique", {normal, eye, mirror}},
      {"flank, oblique", {normal, eye, beside}},
      {"dot product rounds above 1", {long_one, long_one, long_one}},
      {"dot product rounds below -1", {long_one, long_one, -long_one}},
      {"L = -V", {{0, 0, 1}, {-1, 0, 0}, {1, 0, 0}}},
      {"L = -V but for 1e-6", mirrored(1e-6)},
      {"L = -V but for an ulp", mirrored(kUlp)},
      {"N.L = 0", at_horizon(0)},
      {"N.L = an ulp", at_horizon(kUlp)},
      {"N.L = -an ulp", at_horizon(-kUlp)},
      {"N.V = 0", eye_at(0)},
      {"N.V = an ulp", eye_at(kUlp)},
      {"N.V = -an ulp", eye_at(-kUlp)},
      {"R.L < 0", {{0, 0, 1}, {0.8, 0, 0.6}, {0.8, 0.1, 0.6}}},
      {"lengths 1e-30", scaled(1e-30)},
      {"lengths 1e30", scaled(1e30)},
      {"denormal float32", scaled(1e-40)},
      {"denormal float64", scaled(1e-310)},
  };
}

/// The stated bound, which covers all angles, narrowed for these vectors. With the light at the horizon or below it, the
/// cosine limits the error; with shadowing, the factor of both cosines does. Where the bound excludes nothing, float64 was
/// chosen. Then it is the change of the lobe at this angle by float64's roundings of the vectors (docs/numerics.md; twice
/// those, because Reflector normalises first).
double bound_here(double stated, const Highlight& h, const ScreenedVectors& v, const Factor& by) {
  constexpr double kUnit = 0x1p-53;
  const auto cosine = static_cast<double>(v.n_dot_l);
  const ModelInfo& model = info(h.model);
  // N.L has four roundings at most.
  if (model.has_shadowing)
    stated = std::min(stated, (double(by.value) + by.error) / by.peak());
  else if (model.applies_cosine || cosine < -4 * kUnit)
    stated = std::min(stated, std::max(0.0, cosine) + 4 * kUnit);
  if (stated < 1) return stated;
  const double roundings =
      model.angle == LobeAngle::kReflection ? 20 : 5 + 4 / std::max(v.half_length, kUnit);
  const auto chord = static_cast<double>(std::sqrt(2 * v.s));
  const double step = 2 * roundings * kUnit;
  const auto at = [&](double c) { return truth::lobe(h.lobe, c * c / 2, h.exponent); };
  const double arithmetic = lobe_float32_error(h.lobe, h.exponent).of_peak * 0x1p-29 + 8 * kUnit;
  return at(std::max(0.0, chord - step)) - at(chord + step) + 2 * arithmetic;
}

}  // namespace

Rows vector_rows(LobeId lobe) {
  Rows rows;
  for (const ModelId model : all_models())
    for (const double n : kExponents) {
      const Highlight h{model, lobe, Normalisation::kExact, n};
      const Reflector reflector({"", h, {1, 1, 1}, {}, Fresnel::kNone});
      const double coefficient = radiance_coefficient(h);
      for (const auto& [name, at] : cases(n)) {
        const ScreenedVectors v = screen(info(model).angle, at);
        const double shape = truth::shape(h, at.normal, at.to_eye, at.to_light);
        const Factor by = factor(h, v.n_dot_l, v.n_dot_v);
        const double lobe = truth::lobe(h.lobe, double(v.s), n), peak = by.peak();
        const bool seen = dot(v.normal, v.to_eye) > 0;
        const double naive = naive::shape(h, at.normal, at.to_eye, at.to_light);

        const double reflected = seen ? shape : 0;
        rows.push_back(judged(
            "vectors", name + " (Reflector)", Subject(h), reflected, judge(naive, reflected, peak),
            judge(reflector.eval(at.normal, at.to_eye, at.to_light).r / coefficient, reflected,
                  peak),
            by.bound(bound_here(2 * shading_error_bound(Precision::kFloat64, h, v.half_length), h,
                                v, by),
                     lobe)));
        const double pdf = reflector.pdf(at.normal, at.to_eye, at.to_light);
        if (!(std::isfinite(pdf) && pdf >= 0)) rows.back().outcome = kOutside;
        if (!seen) continue;  // the kernels are given only what the camera sees

        double bound = 0;
        const Answer ours = judge(by_kernel(h, v, bound), shape, peak);
        rows.push_back(judged("vectors", name, Subject(h), shape, judge(naive, shape, peak), ours,
                              by.bound(bound_here(bound, h, v, by), lobe)));
      }
    }
  return rows;
}

}  // namespace lobelia::stability
