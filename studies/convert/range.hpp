// The best parameters over the whole range, and what rules of thumb make of it.
#pragma once

#include <string>

#include "core/svg_chart.hpp"
#include "records/conversion.hpp"
#include "studies/convert/convert.hpp"

namespace lobelia::conversion {

/// Over exponents from 1 to 1024, or over roughness. `request.parameter` is not used.
records::ConversionTable convert_range(const Request& request);

std::string range_text(const records::ConversionTable& table);
/// The best by the chosen measure and the rules.
Chart range_chart(const records::ConversionTable& table);

}  // namespace lobelia::conversion
