// Parameter tables: each parameter of a scene element is declared once, as data. The scene reader checks against it, and
// the documentation of the scene format is printed from it.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/words/constants.hpp"

namespace lobelia {

enum class ParameterType { kFloat, kInteger, kString, kPoint, kVector, kRgb };

/// XML tag of a parameter of that type, as in Mitsuba: "float", "integer", "string", "point", ...
constexpr std::string_view parameter_tag(ParameterType type) {
  constexpr std::string_view kTags[] = {"float", "integer", "string", "point", "vector", "rgb"};
  return kTags[std::size_t(type)];
}

struct Parameter {
  std::string_view name;
  ParameterType type;
  std::string_view default_value;  ///< as in a file; empty: required
  double min = -kInfinity;         ///< inclusive, of every component
  double max = kInfinity;
  std::string_view unit;
  std::string_view meaning;
};

}  // namespace lobelia
