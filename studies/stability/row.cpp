#include "studies/stability/row.hpp"

#include <algorithm>
#include <cmath>

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
  if (!std::isfinite(value)) return {value, kInfinity, kInfinity, 0};
  const double error = std::abs(value - truth);
  const bool nothing = std::abs(value) < kNothing && std::abs(truth) < kNothing;
  return {value, error / peak, nothing ? 0 : error / unit_in_last_place(truth), 0};
}

std::string_view outcome(const Row& row) {
  const Answer& ours = row.ours;
  // Written so that a NaN is outside.
  const bool holds = std::isfinite(row.truth) && ours.of_peak <= row.bound.of_peak &&
                     ours.ulp <= row.bound.ulp && ours.wrong_pixels == 0 &&
                     (ours.value == 0 || std::isnormal(ours.value));
  if (!holds) return kOutside;
  return row.bound.of_peak < 1 || std::isfinite(row.bound.ulp) ? kWithin : kNotCompared;
}

Row judged(std::string_view group, std::string_view name, const Subject& of, double truth,
           const Answer& naive, const Answer& ours, double bound_of_peak, double bound_ulp) {
  Row row{std::string(group),
          std::string(name),
          std::string(of.model),
          std::string(of.lobe),
          of.exponent,
          truth,
          naive,
          ours,
          {bound_of_peak, bound_ulp},
          ""};
  row.outcome = outcome(row);
  return row;
}

}  // namespace lobelia::stability
