// The values of an axis while its grid is read: each once, found by its text.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "farm/grid.hpp"

namespace lobelia {

inline constexpr std::size_t kMaxAxisValues = 10000;
/// Shapes, materials and lights of all scenes of an axis, which stay in memory.
inline constexpr std::size_t kMaxHeldParts = 10000000;

std::size_t part_count(const Scene& scene);  ///< shapes, materials and lights

class AxisTable {
 public:
  AxisTable(const AxisKind& kind, std::filesystem::path directory)
      : kind_(&kind), directory_(std::move(directory)), axis_{std::string(kind.name), {}} {}

  const Axis& axis() const { return axis_; }
  Axis take() { return std::move(axis_); }

  std::optional<ValueIndex> find(const std::string& text) const;
  /// The value's index; it is read where it is new. Throws std::runtime_error as AxisKind::parse does, and where
  /// values are too many or would have the same file name.
  ValueIndex find_or_add(const std::string& text);

 private:
  const AxisKind* kind_;
  std::filesystem::path directory_;
  Axis axis_;
  std::unordered_map<std::string, ValueIndex> by_text_;
  std::unordered_set<std::string> tokens_;
  std::size_t parts_ = 0;
};

}  // namespace lobelia
