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
/// With the radius that its source gives it.
std::optional<Filter> find_filter(std::string_view name);

/// Draws offsets from a pixel's centre with a density proportional to |filter|, so that every sample
/// counts the same but for the sign (Ernst, Stamminger, Greiner 2006: filter importance sampling).
class FilterSampler {
 public:
  explicit FilterSampler(Filter filter);

  struct Offset {
    double offset;  ///< pixels, |offset| <= radius
    double weight;  ///< the mean of weights is 1; negative where the filter is
  };
  /// u in [0, 1).
  Offset operator()(double u) const;

 private:
  bool box_;
  double radius_, scale_ = 1;
  std::vector<double> cumulative_;  ///< of |filter| over equal steps from -radius to radius, 0 to 1
  std::vector<bool> negative_;
};

}  // namespace lobelia
