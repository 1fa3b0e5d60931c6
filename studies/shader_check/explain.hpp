// Explanations for the difference between a shader and its model.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/records/shader_check.hpp"
#include "studies/shader_check/points.hpp"

namespace lobelia::shader_check {

/// A shader's values.
struct Observed {
  std::vector<Point> points;
  std::vector<double> values;
  /// Counts for messages, if more calls were made than these.
  std::size_t calls = 0, nan = 0;
};

/// The rounding in float32 of a textbook's power of a cosine, relative to the peak; an explanation may leave as much.
double textbook_rounding(double exponent);
/// The largest error of a shader that passes, relative to the peak: the same, but no more than anybody could see.
double allowed_error(double exponent);

/// Tries the mistakes of mistakes.hpp one by one, then in pairs, each with every coefficient. The simplest that leaves
/// rounding alone is the explanation; without one it is the nearest.
records::ShaderExplanation explain(const Highlight& highlight, const Observed& observed,
                                   bool of_roughness);

/// The same for a shader without a model. No mistakes: it is the model.
struct Identified {
  Highlight highlight;  ///< of the simplest explanation
  records::ShaderExplanation explanation;
};
Identified identify(std::span<const Highlight> highlights, const Observed& observed,
                    bool of_roughness);
/// All names that an explanation may have.
std::vector<std::string_view> mistake_names();
/// Each model with each lobe, the usual lobes first.
std::vector<Highlight> all_highlights();

}  // namespace lobelia::shader_check
