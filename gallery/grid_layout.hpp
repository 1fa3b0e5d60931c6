// How a grid of any number of axes lies on a page of two dimensions.
#pragma once

#include <string>
#include <vector>

#include "gallery/shown_farm.hpp"

namespace lobelia::gallery {

/// The first axis runs down, the third across, the second groups the columns, and every combination
/// of the others has a section of its own; one or two axes leave out the rest. The light is always
/// taken last, and columns that would be too many are not grouped. -1: no such axis.
struct GridLayout {
  int rows = -1, groups = -1, columns = -1;
  std::vector<int> section_axes;
  /// Index on each section axis, in the grid's order; one empty entry if there are none.
  std::vector<std::vector<int>> sections;

  /// The place of a cell on all axes.
  std::vector<int> position(const std::vector<int>& section, int row, int group, int column) const;
  /// "Light: 45 degrees"; empty if there are no section axes.
  std::string section_label(const ShownFarm& farm, const std::vector<int>& section) const;
};

/// Throws Error(kInput) if the axes span more places than a page can show.
GridLayout lay_out(const ShownFarm& farm);

/// Number of values, or 1 where there is no such axis.
int axis_size(const ShownFarm& farm, int axis);

/// Cells that have no place: a value that its axis does not list, or a place that is taken.
std::vector<const CellEntry*> cells_without_place(const ShownFarm& farm);

}  // namespace lobelia::gallery
