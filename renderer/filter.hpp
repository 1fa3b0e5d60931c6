// Reconstruction filters: the weight of a sample by its distance from the pixel's centre.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace lobelia {

/// A separable filter: index in the catalogue (renderer/filters.hpp) and half its width.
struct Filter {
  std::uint8_t index = 0;  ///< 0 is the box
  double radius = 0.5;     ///< pixels, > 0; the box of radius 0.5 is the pixel itself
  friend bool operator==(const Filter&, const Filter&) = default;
};

std::span<const std::string_view> filter_names();
std::string_view name(Filter filter);
/// The filter's value along one axis, not normalised; x in [-1, 1], in units of the radius.
double filter_value(Filter filter, double x);
/// The distance in pixels up to which samples may affect a pixel: the radius and half a pixel, rounded up.
int reach_of(Filter filter);
/// The filter with the default radius of its source.
std::optional<Filter> find_filter(std::string_view name);

/// Draws offsets from a pixel's centre with a density proportional to |filter|, separately for the filter's
/// positive and negative parts (after Ernst, Stamminger, Greiner 2006: filter importance sampling). The part of
/// sample k is fixed, so that the numbers of samples in the parts are not random
/// (docs/decisions/0002-rays.md).
class FilterSampler {
 public:
  explicit FilterSampler(Filter filter);

  /// The part of sample k, and its index among the samples of that part.
  struct Place {
    bool negative;
    std::uint32_t index;
  };
  Place place(std::uint32_t k) const;

  struct Offset {
    double x, y;  ///< pixels, each at most the radius
  };
  /// An offset in one part; u and v in [0, 1).
  Offset operator()(bool negative, double u, double v) const;

  /// The weight of the negative part's mean; the positive part's is larger by 1. 0 for a filter without negative
  /// values.
  double negative_weight() const { return negative_weight_; }

 private:
  /// The inverse of a distribution along one axis, from [0, 1) to [-radius, radius].
  struct Axis {
    std::vector<double> cumulative;  ///< over equal steps, 0 to 1
    double operator()(double u, double radius) const;
  };

  bool box_;
  double radius_;
  Axis above_, below_;      ///< of the filter's positive and negative values along an axis
  double above_share_ = 1;  ///< share of the positive part that is positive along both axes
  double negative_weight_ = 0;
  std::uint32_t negative_every_ = 0;  ///< every how many samples one is negative; 0: never
};

/// A place of a pixel; the weighted sum of all is the pixel's mean with the film's filter.
struct FilterNode {
  double x, y;    ///< from the pixel's centre, pixels, y down
  double weight;  ///< of the value there; below 0 where the filter is
};

/// Weights sum to 1. By Gauss's quadrature with the filter as its weight, along each axis: exact for polynomials of
/// degree 5, or 7 if the filter's second moment is above 0.1 square pixels. A filter without such a rule gets that of
/// Gauss and Legendre, 4 nodes in each quarter of its width.
std::vector<FilterNode> filter_nodes(Filter filter);

}  // namespace lobelia
