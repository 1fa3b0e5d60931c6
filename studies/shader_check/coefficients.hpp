// Names for the coefficient that fits a shader.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studies/shader_check/points.hpp"

namespace lobelia::shader_check {

/// A coefficient in the shader as fitted at an exponent.
struct FittedCoefficient {
  double exponent = 1, lobe_exponent = 1;  ///< asked for, and used by the shader's lobe
  double value = 0, tolerance = 0;         ///< and its relative error
};

/// Cost 0 is the model's own; each mistake costs 1 or, with fitted numbers, a little more.
struct NamedCoefficient {
  std::vector<std::string_view> ids;
  std::string words;
  double cost = 0;
  bool is_known = true;
};

class CoefficientNames {
 public:
  explicit CoefficientNames(const Highlight& highlight) : highlight_(highlight) {}
  double own(double exponent);
  /// For a lobe that may not be the model's. `is_exposed`: any constant factor is an exposure.
  NamedCoefficient name(std::span<const FittedCoefficient> fitted, const LobeId& lobe,
                        bool is_exposed);

 private:
  double exact(ModelId model, const LobeId& lobe, double exponent);
  Highlight highlight_;
  std::map<std::pair<int, double>, double> exact_;  // by model, of the highlight's lobe
};

std::vector<std::string_view> coefficient_mistake_names();

/// The model's own coefficient of cos^n as a formula, with the quarter of a distribution: "(n + 1) / (8 pi)".
std::string own_coefficient_text(const Highlight& highlight);

}  // namespace lobelia::shader_check
