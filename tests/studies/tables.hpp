// Small tables whose fronts can be seen by eye.
#pragma once

#include "studies/cost/table.hpp"

namespace lobelia::cost {

inline Variant variant(const char* name, double seconds, double error, double spread = 0) {
  Variant result{name, {{"lobe", name}}, {{"max", error}}, {}, {}, {}, {}, {}};
  result.seconds = records::MeasuredRounds{seconds, spread, seconds, seconds, 5};
  return result;
}

inline Table table(std::vector<Variant> variants) {
  Table result{"lobe-n64",          "lobe", "A lobe", "s", "evaluation", {{"max", "largest error"}},
               std::move(variants), {},     {}};
  add_fronts(result);
  return result;
}

/// The same, counted and not timed.
inline Table counted_table(std::vector<Variant> variants) {
  Table result = table(std::move(variants));
  result.unit = "bit operations";
  for (Variant& variant : result.variants) {
    variant.count = variant.seconds->median;
    variant.seconds.reset();
  }
  result.fronts.clear();
  add_fronts(result);
  return result;
}

}  // namespace lobelia::cost
