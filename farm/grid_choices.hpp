// The values of a grid file's axes, what it takes away from their product, and what it adds.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "farm/grid.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {

inline constexpr std::size_t kMaxAxisValues = 10000;
/// Shapes, materials and lights of all scenes of an axis, which stay in memory.
inline constexpr std::size_t kMaxHeldParts = 10000000;

std::size_t part_count(const Scene& scene);  ///< shapes, materials and lights

/// The values of an axis while its grid is read: each once, found by its text.
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

/// Reads the <exclude> and <include> elements of `root` and fills the grid's axes and places, where
/// the values that only an include names come last. Errors are noted in `source`. The product of
/// `factors` has at most kMaxCells cells, and their axes are `axes`, in that order, which are used up.
void read_choices(XmlSource& source, pugi::xml_node root, std::vector<AxisTable>& axes,
                  std::vector<GridFactor> factors, Grid& grid);

}  // namespace lobelia
