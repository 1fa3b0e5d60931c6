// The error map of FLIP, which LDR-FLIP and HDR-FLIP are made of. Source, agreement and why float: see
// flip_ldr.cpp.
#pragma once

#include <functional>
#include <vector>

#include "compare/metrics/flip_filters.hpp"

namespace lobelia {

/// FLIP's error of each pixel of rows [first_row, last_row), in [0, 1].
std::vector<float> flip_error_rows(const DisplayLight& a, const DisplayLight& b,
                                   const FlipFilters& filters, int first_row, int last_row);

struct FlipPooled {
  double mean, max;
};

/// Of a picture whose errors in rows [first, last) are error_rows(first, last), called on many threads.
FlipPooled flip_pooled(int width, int height,
                       const std::function<std::vector<float>(int first, int last)>& error_rows);

}  // namespace lobelia
