// What a grid file takes away from the product of its axes, and what it adds.
#pragma once

#include <vector>

#include "farm/axis_table.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {

/// Reads the <exclude> and <include> elements of `root` and fills the grid's axes and places, where
/// the values that only an include names come last. Errors are noted in `source`. The product of
/// `factors` has at most kMaxCells cells, and their axes are `axes`, in that order, which are used up.
void read_choices(XmlSource& source, pugi::xml_node root, std::vector<AxisTable>& axes,
                  std::vector<GridFactor> factors, Grid& grid);

}  // namespace lobelia
