// The hard cases: every lobe of the catalogue is taken through all of them.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/records/stability.hpp"
#include "base/words/constants.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::stability {

/// One hard case: the truth, the textbook's float32, and ours.
using Row = records::StabilityRow;
using Rows = std::vector<Row>;
/// A result and its error: in float32's units in the last place at the truth, and relative to the highlight's peak.
/// Infinite where the result is no number.
using Answer = records::StabilityAnswer;

/// A row's outcome. Not compared: a number, but its stated bound excludes no number.
inline constexpr std::string_view kWithin = "within", kOutside = "outside",
                                  kNotCompared = "not compared";

/// `peak` is the highlight's value in its middle. A truth and a value below the smallest normal float32 are equal.
Answer judge(double value, double truth, double peak);

/// Within both bounds, no wrong pixel, and 0 or a normal number. A lobe is 0 to 1 of its peak: a bound of the whole
/// peak compares nothing.
std::string_view outcome(const Row& row);

/// A row of a highlight, or of a lobe alone.
struct Subject {
  explicit Subject(const Highlight& h)
      : model(info(h.model).name), lobe(info(h.lobe).name), exponent(h.exponent) {}
  Subject(LobeId l, double n) : lobe(info(l).name), exponent(n) {}
  std::string_view model = {}, lobe;
  double exponent;
};
Row judged(std::string_view group, std::string_view name, const Subject& of, double truth,
           const Answer& naive, const Answer& ours, double bound_of_peak,
           double bound_ulp = kInfinity);

inline constexpr std::array kExponents{0.1, 1.0, 2.0, 15.9, 16.0, 1024.0, 1e4, 1e6, 1e8};

/// s at which the lobe has fallen to `value`, by bisection.
double s_of_value(LobeId lobe, double exponent, double value, int halvings);

/// Every listed lobe, and two unlisted ones of the family cs_k: an order that is no power of two, and the largest.
std::vector<LobeId> lobes_under_test();

/// The lobe alone in float32 at a float32 s: at hard angles, at its end, and where it becomes denormal. The bounds are
/// stated in the lobe's file.
Rows lobe_rows(LobeId lobe);

/// The coefficient of every model, by closed form or moments, to kCoefficientBound of itself.
inline constexpr double kCoefficientBound = 1e-14;
Rows coefficient_rows(LobeId lobe);

/// Hard vectors: in the kernels, in the precision that the plan would choose, and in Reflector, which takes any. The
/// bound is shading_error_bound; twice that for Reflector, which normalises them first. Its pdf must be finite too.
Rows vector_rows(LobeId lobe);

/// The density of samples over s, down to its underflow: never denormal, never below 0, and to kDensityBound of its
/// peak. An exponential of x nats is off by x e^-x of the peak for each rounding of x: 0.37 of a rounding at most.
inline constexpr double kDensityBound = 1e-13;
Rows density_rows(LobeId lobe);

struct HardScene {
  std::string name;
  Scene scene;  ///< without highlights
};
/// Scenes with hard geometry: extreme sizes, distances and positions.
std::vector<HardScene> hard_scenes();
/// The scene from so close that a highlight of that exponent fills the picture; nothing if the first light makes no
/// highlight on the first sphere.
std::vector<Scene> close_to_highlight(Scene scene, double exponent);

/// Scenes of spheres rendered whole, and close to the highlight; to kAllowedShadingError of the peak.
Rows sphere_rows(LobeId lobe);

/// 1e5 random vectors, grazing ones among them, and the worst of them made worse: each precision against its stated
/// bound, and the chosen one against kAllowedShadingError. All lobes see the same vectors, the naive formula some of
/// them.
Rows precision_rows(const std::vector<LobeId>& lobes, double exponent);

/// Random vectors in half floats, n = 8 to 1024: the worst of those for which shading_error_bound says anything, and the
/// textbook's worst.
inline constexpr std::array kHalfFloatExponents{8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, 1024.0};
Rows float16_rows(LobeId lobe);

}  // namespace lobelia::stability
