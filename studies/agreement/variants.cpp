#include "studies/agreement/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lobelia::agreement {
namespace {

constexpr ExponentTarget kOursTargets[] = {{1e6, {false, 1e-5}}};
constexpr EngineVariant kOursVariant{.name = "ours", .title = "Lobelia", .targets = kOursTargets};

}  // namespace

const Variant& ours() {
  static const Variant variant{"", kOursVariant};
  return variant;
}

std::span<const Variant> variants() {
  static const std::vector<Variant> all = [] {
    std::vector<Variant> found;
    for (const EngineInfo& engine : engine_infos())
      for (const EngineVariant& variant : engine.variants) found.push_back({engine.name, variant});
    return found;
  }();
  return all;
}

Variant pair_of(std::string_view first, std::string_view second) {
  struct Names {
    std::string name, title;
  };
  static std::map<std::pair<std::string_view, std::string_view>, Names> pairs;
  Names& names = pairs[{first, second}];
  if (names.name.empty())
    names = {fmt::format("{}_{}", first, second),
             fmt::format("{} against {}", engine_info(first).title, engine_info(second).title)};
  return {"", {.name = names.name, .title = names.title}};
}

std::optional<Target> target_of(const EngineVariant& variant, double exponent) {
  const auto found = std::ranges::find_if(
      variant.targets, [&](const ExponentTarget& t) { return exponent <= t.up_to; });
  return found == variant.targets.end() ? std::nullopt : std::optional(found->target);
}

std::string short_number(double value) {
  if (value == 0) return "0";
  if (!std::isfinite(value)) return "inf";
  std::string text = fmt::format("{:.1e}", value);  // 4.9e-04
  const auto digits = text.find('e') + 2;
  while (digits + 1 < text.size() && text[digits] == '0') text.erase(digits, 1);
  if (text[digits - 1] == '+') text.erase(digits - 1, 1);
  if (const auto zero = text.find(".0e"); zero != std::string::npos) text.erase(zero, 2);
  return text;
}

std::string target_text(const Target& target) {
  return fmt::format("{} of the {}", short_number(target.limit),
                     target.relative ? "value" : "peak");
}

}  // namespace lobelia::agreement
