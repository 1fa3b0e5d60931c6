// Round numbers along an axis.
#pragma once

#include <string>
#include <vector>

namespace lobelia {

struct Tick {
  double value = 0;
  std::string label;  ///< empty: a minor tick
};

/// Multiples of 1, 2 or 5 times a power of ten, about `count` of them inside [from, to].
std::vector<Tick> linear_ticks(double from, double to, int count);
/// Powers of ten inside [from, to] with labels "10⁻³"; 2 to 9 times them as minor ticks if there
/// are few decades, every second or third power labelled if there are many.
std::vector<Tick> log_ticks(double from, double to);
/// A round number at or above `value`, to end an axis with; 1 if value is not positive.
double round_up(double value);

}  // namespace lobelia
