// Explanations for the difference between a shader and its model.
#pragma once

#include <string>
#include <vector>

#include "base/records/shader_check.hpp"
#include "studies/shader_check/points.hpp"

namespace lobelia::shader_check {

/// A shader's values. explain() ignores those that are not finite.
struct Observed {
  std::vector<Point> points;
  std::vector<double> values;
};

/// The rounding in float32 of a textbook's power of a cosine, relative to the peak; an explanation may leave as much.
double textbook_rounding(double exponent);
/// The largest error of a shader that passes, relative to the peak: the same, but no more than anybody could see.
double allowed_error(double exponent);

/// Tries the mistakes of mistakes.hpp one by one, then in pairs, each with every coefficient. The simplest that leaves
/// rounding alone is the explanation; without one it is the nearest.
records::ShaderExplanation explain(const Highlight& highlight, const Observed& observed,
                                   bool of_roughness);

}  // namespace lobelia::shader_check
