#include "verify/stability/row.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lobelia::stability {
namespace {

constexpr double kSmallest = std::numeric_limits<float>::min();
/// The exponent at which a lobe ends is rounded too, so it may end a little before the smallest number.
constexpr double kNothing = 1.001 * kSmallest;

double unit_in_last_place(double value) {
  return std::ldexp(1.0, std::ilogb(std::max(std::abs(value), kSmallest)) - 23);
}

}  // namespace

Answer judge(double value, double truth, double peak) {
  if (!std::isfinite(value)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {value, kInfinity, kInfinity};
  }
  const double error = std::abs(value - truth);
  const bool nothing = std::abs(value) < kNothing && std::abs(truth) < kNothing;
  return {value, nothing ? 0 : error / unit_in_last_place(truth), error / peak};
}

std::string_view name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kWithin:
      return "within";
    case Outcome::kNotCompared:
      return "not compared";
    case Outcome::kOutside:
      break;
  }
  return "outside";
}

Outcome outcome(const Row& row) {
  const Answer& ours = row.ours;
  // Written so that a NaN is outside.
  const bool holds = std::isfinite(row.truth) && ours.of_peak <= row.bound_of_peak &&
                     ours.ulp <= row.bound_ulp && ours.wrong_pixels == 0 &&
                     (ours.value == 0 || std::isnormal(ours.value));
  if (!holds) return Outcome::kOutside;
  return row.bound_of_peak < 1 || std::isfinite(row.bound_ulp) ? Outcome::kWithin
                                                               : Outcome::kNotCompared;
}

}  // namespace lobelia::stability
