// The values of a grid file's axes, what it takes away from their product, and what it adds.
#pragma once

#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "farm/grid.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {

inline constexpr std::size_t kMaxAxisValues = 10000;

/// An axis, or the axes of a list: each step has one value of each axis.
struct GridFactor {
  std::vector<std::vector<ValueIndex>> steps;  ///< by axis; all of one length, at least 1

  std::size_t size() const { return steps.front().size(); }
};

std::size_t part_count(const Scene& scene);  ///< shapes, materials and lights

/// The values of an axis while its grid is read: each once, by its text.
class AxisTable {
 public:
  AxisTable(const AxisKind& kind, std::filesystem::path directory)
      : kind_(&kind), directory_(std::move(directory)), axis_{std::string(kind.name), {}} {}

  const Axis& axis() const { return axis_; }
  Axis take() { return std::move(axis_); }

  std::optional<ValueIndex> find(const std::string& text) const;
  /// Reads the value if it is new. Throws std::runtime_error as AxisKind::parse, for too many values, or two with one token.
  ValueIndex find_or_add(const std::string& text);

 private:
  const AxisKind* kind_;
  std::filesystem::path directory_;
  Axis axis_;
  std::unordered_map<std::string, ValueIndex> by_text_;
  std::unordered_set<std::string> tokens_;
  std::size_t parts_ = 0;
};

/// Reads the <exclude> and <include> elements of `root` and fills the grid's axes and places. Notes errors in `source`.
/// `axes` are those of the factors, in that order, and are used up. The product of `factors` has at most kMaxCells cells.
void read_choices(XmlSource& source, pugi::xml_node root, std::vector<AxisTable>& axes,
                  std::vector<GridFactor> factors, Grid& grid);

}  // namespace lobelia
