// A conversion as text and as a chart.
#pragma once

#include <string>

#include "core/svg_chart.hpp"
#include "records/conversion.hpp"

namespace lobelia::conversion {

std::string conversion_text(const records::Conversion& conversion);
Chart conversion_chart(const records::Conversion& conversion);

}  // namespace lobelia::conversion
