// Places of a pixel whose weighted sum is its mean with the film's filter.
#pragma once

#include <vector>

#include "renderer/filter.hpp"

namespace lobelia {

struct FilterNode {
  double x, y;    ///< from the pixel's centre, pixels, y down
  double weight;  ///< of the value there; below 0 where the filter is
};

/// Weights sum to 1. By Gauss's quadrature with the filter as its weight, along each axis: exact for polynomials of degree 5,
/// or 7 if the filter's second moment is above 0.1 square pixels. A filter without such a rule gets that of Gauss and Legendre,
/// 4 nodes in each quarter of its width.
std::vector<FilterNode> filter_nodes(Filter filter);

}  // namespace lobelia
