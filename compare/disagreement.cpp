#include "compare/disagreement.hpp"

#include <fmt/format.h>

#include <cmath>

#include "compare/metrics/catalogue.hpp"
#include "core/constants.hpp"

namespace lobelia {
namespace {

/// part / whole; 0 if both are 0, infinite if only the whole is.
double share(double part, double whole) {
  if (part == 0) return 0;
  return whole == 0 ? kInfinity : part / whole;
}

/// "takes up 3.1 times its limit (0.031, limit 0.01)"
std::string words(const LimitResult& limit, double share) {
  return fmt::format("{} takes up {:.3g} of its limit ({:.4g}, limit {:g})", limit.metric, share,
                     limit.value, limit.limit);
}

}  // namespace

double share_of_limit(const MetricOutput& output, double value, double limit) {
  if (output.better != Better::kHigher) return share(std::abs(value), limit);
  if (std::isinf(output.best)) return std::pow(10, (limit - value) / 20);
  return share(output.best - value, output.best - limit);
}

std::vector<std::string> disagreements(std::span<const LimitResult> limits) {
  std::vector<std::string> sentences;
  for (const LimitResult& failing : limits)
    for (const LimitResult& passing : limits) {
      if (failing.pass || !passing.pass || std::isnan(failing.value) ||
          failing.standing == Standing::kOpen)
        continue;
      if (find_metric(failing.metric)->family == find_metric(passing.metric)->family) continue;
      const double over =
          share_of_limit(*find_metric_output(failing.metric), failing.value, failing.limit);
      const double under =
          share_of_limit(*find_metric_output(passing.metric), passing.value, passing.limit);
      if (over > kWideMargin || under < 1 / kWideMargin)
        sentences.push_back(fmt::format("{}, but {}", words(failing, over), words(passing, under)));
    }
  return sentences;
}

}  // namespace lobelia
