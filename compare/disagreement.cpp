#include "compare/disagreement.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "compare/metrics/catalogue.hpp"

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
      const Metric &fails = *find_metric(failing.metric), &passes = *find_metric(passing.metric);
      // How wide a highlight is says nothing of its brightness.
      const auto is_figure = [](const Metric& metric) {
        return metric.needs == Needs::kHighlight || metric.needs == Needs::kHighlights;
      };
      if (fails.family == passes.family || fails.region != passes.region || is_figure(fails) ||
          is_figure(passes))
        continue;
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
