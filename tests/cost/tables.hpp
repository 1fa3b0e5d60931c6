// Small tables whose fronts can be seen by eye.
#pragma once

#include "cost/table.hpp"

namespace lobelia::cost {

inline Way way(const char* name, double seconds, double error, double spread = 0) {
  Way result{name, {{"lobe", name}}, {seconds, seconds, seconds, spread, 5}, {error}, {}, {}};
  return result;
}

inline Table table(std::vector<Way> ways) {
  return {"lobe-n64",      "lobe", "A lobe", "evaluation", {{"max", "largest error"}},
          std::move(ways), {}};
}

/// The same, counted and not timed.
inline Table counted_table(std::vector<Way> ways) {
  Table result = table(std::move(ways));
  result.unit = "bit operations";
  return result;
}

}  // namespace lobelia::cost
