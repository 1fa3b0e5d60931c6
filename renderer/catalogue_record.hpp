// The catalogues with all that is known and measured of them, as a record and as the words of tables.
#pragma once

#include <string_view>
#include <vector>

#include "records/models.hpp"
#include "renderer/highlight.hpp"
#include "renderer/lobe_properties.hpp"
#include "renderer/operation_count.hpp"

namespace lobelia {

std::string_view angle_name(LobeAngle angle);           ///< "L and R", "N and H"
std::string_view meaning(Normalisation normalisation);  ///< in a sentence
std::vector<Highlight> all_highlights(
    double exponent);  ///< every model, listed lobe and normalisation

records::Operations operations_record(const OperationCount& count);

/// Everything, measured at one exponent. Kind "models".
records::Models catalogue_record(double exponent);

}  // namespace lobelia
