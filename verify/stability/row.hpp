// One hard case: the truth, what the textbook's float32 makes of it, and what we do.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/highlight.hpp"

namespace lobelia::stability {

/// A result and how far it is off: in units in the last place that float32 has at the truth, and
/// relative to the highlight's peak. Infinite where the result is no number.
struct Answer {
  double value = 0, ulp = 0, of_peak = 0;
  int wrong_pixels = 0;  ///< of a picture: hit instead of miss, the wrong sphere, or no number
};

enum class Outcome {
  kWithin,
  kOutside,
  kNotCompared,  ///< a number, but no bound is stated that any number could exceed
};
std::string_view name(Outcome outcome);  ///< "within", "outside", "not compared"

struct Row {
  std::string group, name, model, lobe;  ///< model is empty where the lobe alone is looked at
  double exponent = 0;
  double truth = 0;
  Answer naive = {}, ours = {};
  double bound_of_peak = 0, bound_ulp = 0;  ///< stated; infinite where nothing is
  Outcome outcome = Outcome::kOutside;
};
using Rows = std::vector<Row>;

/// `peak` is what the highlight has in its middle. A truth and a value below the smallest normal
/// float32 are the same: nothing.
Answer judge(double value, double truth, double peak);

/// Within both bounds, no wrong pixel, and 0 or a normal number. A lobe is 0 to 1 of its peak: a bound of the whole
/// peak compares nothing.
Outcome outcome(const Row& row);

}  // namespace lobelia::stability
