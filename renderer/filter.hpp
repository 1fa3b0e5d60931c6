// Reconstruction filters: how much a sample counts by its distance from the pixel's centre.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace lobelia {

/// A separable filter: index in the catalogue (renderer/filters/catalogue.hpp) and half its width.
struct Filter {
  std::uint8_t index = 0;  ///< 0 is the box
  double radius = 0.5;     ///< pixels, > 0; the box of radius 0.5 is the pixel itself
  friend bool operator==(const Filter&, const Filter&) = default;
};

std::span<const std::string_view> filter_names();
std::string_view name(Filter filter);
/// How many pixels away samples may tell of what a pixel shows: the filter reaches into pixels whose centres are
/// less than half a pixel beyond its radius, and one more is for safety.
int reach_of(Filter filter);
/// With the radius that its source gives it.
std::optional<Filter> find_filter(std::string_view name);

/// Draws offsets from a pixel's centre with a density proportional to |filter|, of the filter's positive and of its
/// negative part apart (after Ernst, Stamminger, Greiner 2006: filter importance sampling). Which part sample k
/// is of is fixed, so that a picture divides by numbers that nothing random decides
/// (docs/decisions/0018-filters-have-two-parts.md).
class FilterSampler {
 public:
  explicit FilterSampler(Filter filter);

  /// Sample k of a pixel: the part it is of, and how many of that part come before it.
  struct Place {
    bool negative;
    std::uint32_t index;
  };
  Place place(std::uint32_t k) const;

  struct Offset {
    double x, y;  ///< pixels, each at most the radius
  };
  /// In one part; u and v in [0, 1).
  Offset operator()(bool negative, double u, double v) const;

  /// The weight of the negative part's mean; that of the positive part counts 1 more. 0 where the filter
  /// is nowhere negative.
  double negative_weight() const { return negative_weight_; }

 private:
  /// The inverse of a distribution along one axis: from [0, 1) to [-radius, radius].
  struct Axis {
    std::vector<double> cumulative;  ///< over equal steps, 0 to 1
    double operator()(double u, double radius) const;
  };

  bool box_;
  double radius_;
  Axis above_, below_;      ///< of where the filter along an axis is positive, and negative
  double above_share_ = 1;  ///< of the positive part: not negative along both axes
  double negative_weight_ = 0;
  std::uint32_t negative_every_ = 0;  ///< samples; 0: never
};

}  // namespace lobelia
