// Decodes the integers of highlight-tables (docs/decisions/0015).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "records/models.hpp"

namespace lobelia::gallery {

/// For each exponent as many numbers.
using Rows = std::vector<std::vector<std::int64_t>>;

/// Throws Error(kInput) where tables do not fit together or have a number that cannot be drawn.
void require_drawable(const records::HighlightTables& tables, const std::string& file);

/// The lobe's value, 0 to 1, of an integer in its curves.
double lobe_value(const records::LobeTable& lobe, std::int64_t number);
/// Radians, of every number of a curve.
std::vector<double> curve_angles(const records::LobeTable& lobe, std::size_t exponent, double n);
/// The albedo of an integer in `seen` or `lit`.
double albedo_of(const records::HighlightTable& highlight, std::int64_t number);
/// Radians, of every number of an albedo, from grazing to normal.
std::vector<double> incidences_of(const records::HighlightTables& tables, double n,
                                  std::size_t count);
/// What leaves of a beam at these incidences, those of the exponent's numbers.
std::vector<double> beam_of(const records::HighlightTable& highlight, std::size_t exponent,
                            const std::vector<double>& incidences);

}  // namespace lobelia::gallery
