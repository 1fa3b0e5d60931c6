// A chart as part of a record, so that a page can draw it again and say its values.
#pragma once

#include "core/record.hpp"
#include "core/svg_chart.hpp"

namespace lobelia {

/// {"id", "title", "description", "x": axis, "y": axis, "bands", "series"}; values to six digits, those that are
/// not finite by their names.
Json chart_record(const Chart& chart);

}  // namespace lobelia
