#include "compare/profile/zones.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace lobelia {

void ZoneErrorSum::add(double difference) {
  finite_ = finite_ && std::isfinite(difference);
  max_abs_ = std::max(max_abs_, std::abs(difference));
  squares_ += difference * difference;
  ++pixels_;
}

ZoneError ZoneErrorSum::error(double peak) const {
  if (pixels_ == 0 || !finite_) return {pixels_, kNaN, kNaN, kNaN};
  return {pixels_, max_abs_, std::sqrt(squares_ / double(pixels_)),
          max_abs_ == 0 ? 0 : max_abs_ / peak};
}

}  // namespace lobelia
