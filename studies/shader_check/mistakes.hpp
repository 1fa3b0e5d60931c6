// The usual mistakes in a highlight's shader, as changes of its formula: what a shader with the mistake computes.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studies/shader_check/formula.hpp"

namespace lobelia::shader_check {

/// The parts of a formula that a mistake may change. A shader has at most one mistake in each.
enum class Part : std::uint8_t {
  kDirection,
  kAngle,
  kExponent,
  kLobe,
  kCosine,
  kGeometryTerm,
  kGuard,
  kBehind,
  kFloor,
  kFresnel,
  kRounding
};

struct Mistake {
  std::string_view id;  ///< "cosine-twice"
  Part part;
  std::string words;                            ///< "the cosine N.L is applied twice"
  bool (*applies)(const Highlight&) = nullptr;  ///< null: always
  std::function<void(Formula&, double n)> change;
  bool of_roughness = false;  ///< only of functions that take a roughness
};
std::span<const Mistake> mistakes();

/// The formula of the model with these mistakes.
Formula formula_of(const Highlight& highlight, double n, std::span<const Mistake* const> made);

}  // namespace lobelia::shader_check
