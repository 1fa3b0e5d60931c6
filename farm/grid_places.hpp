// Which combinations of values a grid has, as numbers: a product of factors, less what is excluded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lobelia {

using ValueIndex = std::uint16_t;  ///< of a value on its axis

/// An axis, or the axes of a list, which advance together: at each step one value of each axis.
struct GridFactor {
  std::vector<std::vector<ValueIndex>> steps;  ///< by axis; all of one length, at least 1

  std::size_t size() const { return steps.front().size(); }
};

/// Combinations that all exclusions of a grid may name together: what is named twice costs twice.
inline constexpr std::size_t kMaxExcluded = 20000000;

class GridPlaces {
 public:
  /// At least one factor; their product has to fit in memory.
  explicit GridPlaces(std::vector<GridFactor> factors);

  /// Takes away every combination whose value is chosen on every axis, where the axes are those of
  /// the factors one after the other; an axis without choices is free. Returns how many it names,
  /// whether they were still there or not. Throws std::runtime_error over kMaxExcluded.
  std::size_t exclude(std::span<const std::vector<bool>> chosen);

  /// The values on all axes, combination after combination, the last factor running fastest.
  std::vector<ValueIndex> kept() const;

 private:
  std::vector<GridFactor> factors_;
  std::vector<bool> excluded_;  ///< by number in the product
  std::size_t named_ = 0;       ///< by all exclusions
};

}  // namespace lobelia
