#include "compare/blind_limits.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "compare/metrics/catalogue.hpp"

namespace lobelia {
namespace {

/// The share of the pixels that a percentile leaves out: 0.05 of "ciede2000.p95". NaN for what is none.
double share_left_out(std::string_view id) {
  const std::size_t dot = id.rfind(".p");
  double percent = kNaN;
  if (dot == std::string_view::npos || !parse_number(std::string(id.substr(dot + 2)), percent))
    return kNaN;
  return 1 - percent / 100;
}

/// Neither a count nor a largest value nor a percentile.
bool is_mean(const MetricOutput& output) {
  return output.unit != Unit::kCount && output.id.find("max") == std::string_view::npos &&
         std::isnan(share_left_out(output.id));
}

}  // namespace

std::vector<std::string> blind_limits(std::span<const LimitResult> limits, double highlight_share) {
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const std::string& id = limits[i].metric;
    const auto same = std::ranges::find(limits.first(i), id, &LimitResult::metric);
    if (same != limits.begin() + std::ptrdiff_t(i))
      sentences.push_back(fmt::format("{} has two limits, {:g} and {:g}: the stricter one decides",
                                      id, same->limit, limits[i].limit));
    const Metric* metric = find_metric(id);
    if (!metric || metric->region != Region::kWhole || !metric->in_regions) continue;
    const double left_out = share_left_out(id);
    if (highlight_share < left_out)
      sentences.push_back(fmt::format(
          "{} leaves out {:.2g} % of the pixels, and the highlight is {:.2g} %: it does not see it",
          id, 100 * left_out, 100 * highlight_share));
    else if (is_mean(*find_metric_output(id)) && highlight_share < kSmallHighlight)
      sentences.push_back(fmt::format(
          "{} is a mean over the whole picture, and the highlight is {:.2g} % of it: it "
          "hardly sees it",
          id, 100 * highlight_share));
  }
  return sentences;
}

}  // namespace lobelia
