// Tables of all highlights over the exponent. A page interpolates them, so its script need not know the formulas.
#pragma once

#include <span>
#include <vector>

#include "records/models.hpp"

namespace lobelia {

/// The exponents of a table, 1 to 2^14, so many to an octave. Between two powers of two everything is smooth:
/// the widths at which lobes of the family cs_k reach the horizon, n = k, are powers of two themselves.
inline constexpr int kTableOctaves = 14, kExponentsPerOctave = 3;
std::vector<double> table_exponents();

/// By how much an interpolated value may be off: a polynomial through the exponents of its octave, over
/// log2 n, of widths, reaches and coefficients that of the logarithm. Of a curve relative to the peak, of the
/// others relative to themselves. A test holds it.
inline constexpr double kCurveTableError = 2e-4, kAlbedoTableError = 2e-3, kWidthTableError = 1e-4,
                        kCoefficientTableError = 1e-3;

/// By how much the cubic through four neighbouring incidences may be off between them, of 1 or of an albedo above it.
inline constexpr double kAlbedoDrawnError = 1e-2;

/// At these exponents, each at least 1. Computes on all processors;
/// for table_exponents() a few seconds.
records::HighlightTables highlight_tables(std::span<const double> exponents);

}  // namespace lobelia
