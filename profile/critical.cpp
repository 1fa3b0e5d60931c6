#include "profile/critical.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace lobelia {
namespace {

using boost::math::complement;

constexpr double kRarest = 38.4;
/// Steps of the table per doubling of the degrees of freedom, and its doublings.
constexpr int kSteps = 64, kDoublings = 20;

}  // namespace

double sidak(double significance, double tests) {
  return -std::expm1(std::log1p(-significance) / tests);
}

double equivalent_z(double t, double freedom, double times) {
  if ((std::isinf(freedom) && times == 1) || std::isinf(t) || t == 0) return t;
  const double own =
      std::isinf(freedom)
          ? boost::math::cdf(complement(boost::math::normal(), std::abs(t)))
          : boost::math::cdf(complement(boost::math::students_t(freedom), std::abs(t)));
  const double tail = times * own;
  const double z =
      tail > 0 ? boost::math::quantile(complement(boost::math::normal(), tail)) : kRarest;
  return std::copysign(std::min(z, kRarest), t);
}

CriticalT::CriticalT(double each)
    : normal_(boost::math::quantile(complement(boost::math::normal(), each / 2))) {
  for (int i = 0; i <= kSteps * kDoublings; ++i)
    values_.push_back(boost::math::quantile(
        complement(boost::math::students_t(std::exp2(double(i) / kSteps)), each / 2)));
}

double CriticalT::operator()(double freedom) const {
  // Rounded down: fewer degrees of freedom are the safe choice.
  const double place = kSteps * std::log2(std::max(freedom, 1.0));
  return values_[std::size_t(std::min(place, double(values_.size() - 1)))];
}

}  // namespace lobelia
