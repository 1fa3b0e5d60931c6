#include "cli/compare_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/set/report.hpp"
#include "core/text.hpp"

namespace lobelia::cli {
namespace {

std::string reasons(const LayerComparison& layer) {
  if (!layer.comparison) return layer.problem;
  const Comparison& comparison = *layer.comparison;
  if (comparison.verdict == Verdict::kNonFinite) return why_not_pass(comparison);
  std::string text;
  for (const LimitResult& limit : comparison.limits)
    text += fmt::format("{}{} {:.4g}{}", text.empty() ? "" : ", ", limit.metric, limit.value,
                        limit.pass ? "" : fmt::format(" (limit {:g})", limit.limit));
  return text;
}

void print_names(const char* where, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    fmt::print("  only in {}: {}\n", where, name.empty() ? "the picture" : printable(name));
}

}  // namespace

std::string main_layer(const std::string& a, const std::string& b, const LayerOptions& options) {
  if (!options.all || !options.layer.empty()) return options.layer;
  return common_layers(a, b).both.front();
}

std::optional<OtherLayers> compare_other_layers(const std::string& a, const std::string& b,
                                                const std::string& main,
                                                const LayerOptions& options,
                                                const ComparisonOptions& comparison) {
  if (!options.all) return std::nullopt;
  OtherLayers result{common_layers(a, b), {}};
  std::vector<std::string> names = result.common.both;
  std::erase(names, main);
  result.compared = compare_layers(a, b, names, comparison);
  return result;
}

void print_layers(const OtherLayers& layers) {
  fmt::print("\n");
  for (const LayerComparison& layer : layers.compared)
    fmt::print("  layer {}: {}; {}\n",
               layer.name.empty() ? "of the picture" : printable(layer.name),
               verdict_name(layer.comparison ? layer.comparison->verdict : Verdict::kDiffers),
               reasons(layer));
  print_names("a", layers.common.only_a);
  print_names("b", layers.common.only_b);
}

}  // namespace lobelia::cli
