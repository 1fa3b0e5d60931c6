// Mistakes in the use of a result, and their inverses: which radiance a shader's value may come from.
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace lobelia::shader_check {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct OutputStep {
  std::string_view id, words;
  double (*value)(double radiance);  ///< null of a step that was fitted
  double (*inverse)(double value);
  /// The values that it may give. At an end of the range, any radiance beyond is possible.
  double least, most;
  bool is_tone_mapping = false;
  double rounding = 0;         ///< by which float32 is off near 0, as where 1 is taken away
  std::string_view also = {};  ///< another mistake that is in it
  double exponent = 0;         ///< if not 0, it is value^exponent in place of the functions
};
std::span<const OutputStep> output_steps();
OutputStep clamp_to(double most, std::string_view words);
OutputStep power_step(double exponent, std::string_view words);

/// One after the other. Of a tone mapping, a second step may be a multiplication.
using Chain = std::vector<const OutputStep*>;
std::vector<Chain> chains_of_two();

/// The radiance that gives a value, and how far it may be off below and above if the value is off by `error`.
struct Origin {
  double radiance = 0, below = 0, above = 0;
  bool is_possible =
      true;  ///< false: a step gives no such value, as a clamp gives none beyond its end
};
Origin origin_of(const Chain& chain, double value, double error);

}  // namespace lobelia::shader_check
