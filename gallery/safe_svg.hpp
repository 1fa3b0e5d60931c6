// Whether an SVG file of a run may be published: a browser that opens it would run what it has of scripts.
#pragma once

#include <cstddef>
#include <string_view>

namespace lobelia::gallery {

inline constexpr std::size_t kMaxChartBytes = std::size_t{4} << 20;

/// True if the file has only the elements and attributes of a drawn chart: shapes, words and a style sheet without
/// addresses.
bool is_safe_svg(std::string_view file);

}  // namespace lobelia::gallery
