// Places a grid of any number of axes on a page of two dimensions.
#pragma once

#include "gallery/shown_farm.hpp"

namespace lobelia::gallery {

/// The first axis runs down, the second groups the columns, the third runs across, and every combination
/// of the others has a section of its own. With fewer axes, or too many columns, there are no groups. The light is
/// always the last axis. -1: no such axis. A single axis that is too long for a line is a list: it has no columns either.
struct GridLayout {
  int rows = -1, groups = -1, columns = -1;
  std::vector<int> section_axes;
  /// For each section its index on each section axis, in the grid's order; one empty entry without section axes.
  std::vector<std::vector<int>> sections;

  /// The index on each axis of the cell at this place.
  std::vector<int> position(const std::vector<int>& section, int row, int group, int column) const;
  /// "Light: 45 degrees"; empty if there are no section axes.
  std::string section_label(const ShownFarm& farm, const std::vector<int>& section) const;
};

bool is_list(const ShownFarm& farm);

/// Throws Error(kInput) if the axes span more places than a page can show.
GridLayout lay_out(const ShownFarm& farm);

/// Number of values, or 1 where there is no such axis.
int axis_size(const ShownFarm& farm, int axis);

/// Cells with a value that its axis does not list, or with the place of another cell.
std::vector<const CellEntry*> cells_without_place(const ShownFarm& farm);

}  // namespace lobelia::gallery
