// What explains the difference between a shader and its model.
#pragma once

#include <string>
#include <vector>

#include "records/shader_check.hpp"
#include "studies/shader_check/points.hpp"

namespace lobelia::shader_check {

/// What a shader gave. Values that are not finite are left out by explain().
struct Observed {
  std::vector<Point> points;
  std::vector<double> values;
};

/// What float32 leaves of a power of a cosine as in textbooks, relative to the peak; an explanation may leave as much.
double textbook_rounding(double exponent);
/// The largest error of a shader that passes, relative to the peak: the same, but no more than anybody could see.
double allowed_error(double exponent);

/// Tries the mistakes of mistakes.hpp one by one, then in pairs, each with every coefficient. The simplest that leaves
/// rounding alone is the explanation; without one it is the nearest.
records::ShaderExplanation explain(const Highlight& highlight, const Observed& observed,
                                   bool of_roughness);

}  // namespace lobelia::shader_check
