// The combinations of values that a grid has, as numbers: a product of factors without what is excluded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lobelia {

using ValueIndex = std::uint16_t;  ///< of a value on its axis

/// An axis, or the axes of a list: each step has one value of each axis.
struct GridFactor {
  std::vector<std::vector<ValueIndex>> steps;  ///< by axis; all of one length, at least 1

  std::size_t size() const { return steps.front().size(); }
};

/// Combinations that all exclusions of a grid may name together, counted as often as they are named.
inline constexpr std::size_t kMaxExcluded = 20000000;

class GridPlaces {
 public:
  /// At least one factor; their product has to fit in memory.
  explicit GridPlaces(std::vector<GridFactor> factors);

  /// Removes the combinations of chosen values; an axis without choices is free. Axes are those of the factors, in order.
  /// Returns how many combinations it names, there or not. Throws std::runtime_error over kMaxExcluded.
  std::size_t exclude(std::span<const std::vector<bool>> chosen);

  /// The values on all axes, combination after combination, the last factor running fastest.
  std::vector<ValueIndex> kept() const;

 private:
  std::vector<GridFactor> factors_;
  std::vector<bool> excluded_;  ///< by number in the product
  std::size_t named_ = 0;       ///< by all exclusions
};

}  // namespace lobelia
