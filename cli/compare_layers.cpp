#include "cli/compare_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/set/report.hpp"
#include "core/text.hpp"

namespace lobelia::cli {
namespace {

std::string reasons(const LayerComparison& layer, const std::string& a, const std::string& b) {
  if (layer.identical) return "identical";
  if (!layer.comparison) return layer.problem;
  const Comparison& comparison = *layer.comparison;
  if (comparison.verdict == Verdict::kNonFinite) return why_not_pass(comparison, a, b);
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

void print_layers(const OtherLayers& layers, const std::string& a, const std::string& b) {
  if (!layers.compared.empty() || layers.common) fmt::print("\n");
  for (const LayerComparison& layer : layers.compared)
    fmt::print("  {}: {}; {}\n", layer.title(), verdict_name(layer.verdict()),
               reasons(layer, a, b));
  if (layers.common) {
    print_names("a", layers.common->only_a);
    print_names("b", layers.common->only_b);
  }
  if (!is_empty(layers.not_compared))
    fmt::print("  not compared: {}\n", to_text(layers.not_compared));
}

void print_profiles(const PicturePairSource& sources) {
  for (const auto& [name, source] : {std::pair('a', &sources.a), {'b', &sources.b}})
    if (!source->icc_profile.empty() && !source->icc_is_srgb)
      fmt::print("  {}: its ICC profile '{}' is not sRGB, and is not applied\n", name,
                 printable(source->icc_profile));
}

}  // namespace lobelia::cli
