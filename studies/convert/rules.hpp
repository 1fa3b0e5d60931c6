// Rules of thumb that programs in use convert a parameter by.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "studies/convert/curve.hpp"

namespace lobelia::conversion {

struct Rule {
  std::string_view name;     ///< "FBX2glTF"
  std::string_view formula;  ///< "roughness = sqrt(2 / (n + 2))"
  std::string_view source;
  /// The parameter of the target from that of the source; none if the rule has no answer.
  std::optional<double> (*convert)(double parameter);
};

/// From an exponent to GGX the rules themselves; back from GGX the same rules solved for n. From an exponent to an exponent
/// the rules differ by whether the angle of the lobe does.
std::span<const Rule> rules(ShadingModel from, ShadingModel to);

}  // namespace lobelia::conversion
