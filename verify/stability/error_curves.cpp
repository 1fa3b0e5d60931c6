#include "verify/stability/error_curves.hpp"

#include <cmath>
#include <numbers>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "verify/stability/by_kernel.hpp"
#include "verify/stability/naive.hpp"

namespace lobelia::stability {
namespace {

constexpr int kPoints = 120;
constexpr double kEnd = 1e-3;  // of the peak

ErrorCurve error_curve(double n) {
  const Highlight h{*find_model("modified_phong"), *find_lobe("cosine"), Normalisation::kExact, n};
  ErrorCurve curve{n, std::string(info(h.model).name), std::string(info(h.lobe).name), {}, {}, {},
                   {}};
  // (2, 13, 31) is the mirror direction of (2, 3, 1) about (1, 2, 2), exactly; (13, -2, 0) is square to it.
  const Vec3 normal{1, 2, 2}, eye{2, 3, 1}, mirror{2, 13, 31}, beside{13, -2, 0};
  const double reach = std::acos(std::pow(kEnd, 1 / n));
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = reach * i / kPoints;
    const Vec3 light = mirror + std::tan(angle) * length(mirror) / length(beside) * beside;
    double bound = 0;
    curve.degrees.push_back(angle * 180 / std::numbers::pi);
    curve.truth.push_back(truth::shape(h, normal, eye, light));
    curve.naive.push_back(naive::shape(h, normal, eye, light));
    curve.ours.push_back(by_kernel(h, screen(info(h.model).angle, {normal, eye, light}), bound));
  }
  return curve;
}

}  // namespace

std::vector<ErrorCurve> error_curves() {
  std::vector<ErrorCurve> curves;
  for (const double n : {16.0, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) curves.push_back(error_curve(n));
  return curves;
}

}  // namespace lobelia::stability
