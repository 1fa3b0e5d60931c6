// One hard case: the truth, the textbook's float32, and ours.
#pragma once

#include <string_view>
#include <vector>

#include "core/constants.hpp"
#include "records/stability.hpp"
#include "renderer/highlight.hpp"

namespace lobelia::stability {

using Row = records::StabilityRow;
using Rows = std::vector<Row>;
/// A result and its error: in float32's units in the last place at the truth, and relative to the highlight's peak.
/// Infinite where the result is no number.
using Answer = records::StabilityAnswer;

/// A row's outcome. Not compared: a number, but no bound is stated that any number could exceed.
inline constexpr std::string_view kWithin = "within", kOutside = "outside",
                                  kNotCompared = "not compared";

/// `peak` is the highlight's value in its middle. A truth and a value below the smallest normal float32 are the same:
/// nothing.
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

}  // namespace lobelia::stability
