// A chart that a record holds (core/chart_record.hpp), read with care.
#pragma once

#include "core/svg_chart.hpp"
#include "gallery/fields.hpp"

namespace lobelia::gallery {

/// `id` is what it is called on the page. Throws Error(kInput) for axes that cannot be drawn.
Chart read_chart(const Fields& fields, const std::string& id);

}  // namespace lobelia::gallery
