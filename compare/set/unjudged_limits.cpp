#include "compare/set/unjudged_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/words/text.hpp"
#include "compare/layer_types.hpp"
#include "compare/metrics/catalogue.hpp"

namespace lobelia {
namespace {

/// Names in the order in which they were met, each once.
class NamesOnce {
 public:
  void add(const std::string& name) {
    if (known_.insert(name).second) names.push_back(name);
  }
  std::vector<std::string> names;

 private:
  std::set<std::string> known_;
};

/// The limits that were given, and those of them that judged something.
struct GivenLimits {
  NamesOnce given;
  std::set<std::string> judged;

  void add(std::span<const MetricLimit> limits) {
    for (const MetricLimit& limit : limits) given.add(limit.metric);
  }
  void add_judged(const Comparison& comparison) {
    for (const auto* results : {&comparison.limits, &comparison.warnings})
      for (const LimitResult& limit : *results) judged.insert(limit.metric);
  }
  /// Counts the limits for a layer that was not measured, because it is identical or of another size.
  void add_judged_by_type(LayerType type) {
    for (const std::string& metric : given.names)
      if (can_judge(type, metric, true)) judged.insert(metric);
  }
};

std::string picture_title(const PairReport& pair) {
  const std::string layer = pair.sources ? pair.sources->b.layer : "";
  return fmt::format("{} ({})", layer.empty() ? "the picture" : "layer " + printable(layer),
                     layer_type_name(pair.comparison->type));
}

/// "a layer of type depth"
std::string needed_by(const std::string& metric) {
  std::vector<std::string_view> types;
  bool is_of_cryptomattes = true;
  for (std::size_t i = 0; i < std::size(records::kLayerTypes); ++i) {
    if (can_judge(LayerType(i), metric, true)) types.push_back(records::kLayerTypes[i]);
    is_of_cryptomattes = is_of_cryptomattes && !can_judge(LayerType(i), metric, false);
  }
  if (is_of_cryptomattes) return "a Cryptomatte";
  return fmt::format("a layer of type {}", fmt::join(types, " or "));
}

std::string some(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 12;  // a hostile file has thousands
  const std::size_t shown = std::min(names.size(), kShown);
  std::string text = fmt::format("{}", fmt::join(std::span(names).first(shown), ", "));
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

}  // namespace

std::vector<std::string> limits_of_other_types(std::span<const MetricLimit> limits, LayerType type,
                                               bool has_coverage) {
  std::vector<std::string> metrics;
  for (const MetricLimit& limit : limits)
    if (!can_judge(type, limit.metric, has_coverage)) metrics.push_back(limit.metric);
  return metrics;
}

void require_judged_limits(const CompareJob& job, std::span<const PairReport> pairs) {
  GivenLimits limits;
  NamesOnce compared, left;
  for (const PairReport& pair : pairs) {
    const bool lacks_a_layer =
        pair.layers && pair.layers->common && !pair.layers->common->only_b.empty();
    if (!pair.comparison || lacks_a_layer) return;
    std::optional<CompareJob> own;
    if (!job.rules.empty()) own = job_of(job, pair.name);
    const ComparisonOptions& options = own ? own->comparison : job.comparison;
    limits.add(options.limits);
    limits.add(options.warnings);
    if (options.tolerance && !options.noise) limits.given.add("outliers");
    limits.add_judged(*pair.comparison);
    compared.add(picture_title(pair));
    if (!pair.layers) continue;
    for (const LayerComparison& layer : pair.layers->compared) {
      compared.add(layer.title());
      if (layer.comparison)
        limits.add_judged(*layer.comparison);
      else
        limits.add_judged_by_type(layer.type);
    }
    for (const std::string& name : pair.layers->not_compared.layers)
      left.add(name.empty() ? "the picture" : "'" + printable(name) + "'");
  }
  for (const std::string& metric : limits.given.names) {
    if (limits.judged.contains(metric)) continue;
    std::string others;
    if (!left.names.empty())
      others = fmt::format("; not compared: {}{}", some(left.names),
                           job.layers.all || job.comparison.noise ? "" : " (try --all-layers)");
    throw Error(ExitCode::kUsage, "the limit on '{}' judged nothing: it needs {}; compared: {}{}",
                metric, needed_by(metric), some(compared.names), others);
  }
}

}  // namespace lobelia
