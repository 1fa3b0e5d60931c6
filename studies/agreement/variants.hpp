// Which pictures are compared with the analytic one, and how near each has to come.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "reference_scenes/engine.hpp"

namespace lobelia::agreement {

struct Variant : EngineVariant {
  std::string_view engine;  ///< empty: ours, or two engines
  Variant(std::string_view by, const EngineVariant& variant) : EngineVariant(variant), engine(by) {}
};

const Variant& ours();
/// The engines' variants. An engine's own formats are tried for in the order given.
std::span<const Variant> variants();
/// Two engines that were told the same formula, compared with each other.
Variant pair_of(std::string_view first, std::string_view second);

/// Nothing where no one has said how near it should come.
std::optional<Target> target_of(const EngineVariant& variant, double exponent);
/// "4.9e-4", "0", "inf"
std::string short_number(double value);
/// "4.9e-4 of the value"
std::string target_text(const Target& target);

}  // namespace lobelia::agreement
