// The catalogues of models and lobes, with formulas and measurements, as records.
#pragma once

#include "base/records/models.hpp"
#include "renderer/lobe_properties.hpp"
#include "renderer/operation_count.hpp"

namespace lobelia {

std::string_view angle_name(LobeAngle angle);           ///< "L and R", "N and H"
std::string_view meaning(Normalisation normalisation);  ///< in a sentence
/// Every model and normalisation of these lobes.
std::vector<Highlight> all_highlights(double exponent, std::span<const LobeId> lobes = all_lobes());

records::Operations operations_record(const OperationCount& count);

/// Everything about all models and these lobes, measured at one exponent. Kind "models".
records::Models catalogue_record(double exponent, std::span<const LobeId> lobes = all_lobes());

// Tables of all highlights over the exponent. A page interpolates them, so its script need not know the formulas.

/// The exponents of a table: 1 to 2^14, three to an octave. Everything is smooth between two powers of two, because
/// lobes of the family cs_k reach the horizon at n = k, a power of two.
inline constexpr int kTableOctaves = 14, kExponentsPerOctave = 3;
std::vector<double> table_exponents();

/// The largest errors of a value interpolated by the polynomial through the exponents of its octave, over log2 n:
/// of the value for curves and albedos, of its logarithm for widths, reaches and coefficients. Relative to the peak
/// for curves, to the value for the others. A test checks them.
inline constexpr double kCurveTableError = 5e-4, kAlbedoTableError = 2e-3, kWidthTableError = 5e-4,
                        kCoefficientTableError = 1e-3;

/// The largest error of the cubic through four neighbouring incidences, relative to the larger of 1 and the albedo.
inline constexpr double kAlbedoDrawnError = 1e-2;

/// At these exponents, each at least 1. Uses all processors; takes a few seconds for table_exponents().
records::HighlightTables highlight_tables(std::span<const double> exponents);

}  // namespace lobelia
