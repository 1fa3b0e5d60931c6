// Limits and tolerances as a user writes them.
#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/set/choice.hpp"

namespace lobelia {

std::string metric_in_short(const std::string& id) {
  const MetricOutput* output = find_metric_output(id);
  return output ? std::string(output->id) : id;
}

MetricLimit parse_limit(std::string_view where, const std::string& text) {
  // The last one, because an id may hold another: relmse.eps=0.01.
  const std::size_t equals = text.rfind('=');
  MetricLimit limit{metric_in_short(text.substr(0, equals)), 0};
  const bool is_percent = text.ends_with('%');
  const std::size_t digits = text.size() - std::min(text.size(), equals + 1) - is_percent;
  if (equals == std::string::npos || !parse_number(text.substr(equals + 1, digits), limit.limit))
    throw Error(ExitCode::kUsage, "{} {}: expected METRIC=LIMIT, for example rmse=0.001", where,
                printable(text));
  const MetricOutput* output = find_metric_output(limit.metric);
  if (is_percent && output && output->unit != Unit::kShare)
    throw Error(ExitCode::kUsage, "{} {}: {} is no share, so its limit is no percentage", where,
                printable(text), limit.metric);
  if (is_percent) limit.limit /= 100;
  if (output && output->better != Better::kNeither)
    if (const std::string problem = limit_problem(*output, limit.limit); !problem.empty())
      throw Error(ExitCode::kUsage, "{} {}: {}", where, printable(text), problem);
  return limit;
}

std::vector<MetricLimit> parse_limits(std::string_view where, std::span<const std::string> texts) {
  std::vector<MetricLimit> limits;
  for (const std::string& text : texts) limits.push_back(parse_limit(where, text));
  return limits;
}

Tolerance parse_tolerance(std::string_view where, const std::string& text) {
  const std::vector<std::string> parts = split(text, ",");
  Tolerance tolerance;
  long long count = 0;
  if (parts.size() != 3 || !parse_number(parts[0], tolerance.relative) ||
      !parse_number(parts[1], tolerance.of_peak) || !parse_integer(parts[2], count))
    throw Error(ExitCode::kUsage,
                "{} {}: expected RELATIVE,OF_PEAK,OUTLIERS, "
                "for example 6e-4,1e-6,3",
                where, printable(text));
  tolerance.allowed_outliers = count;
  return tolerance;
}

}  // namespace lobelia
