#include "farm/grid.hpp"

#include <oneapi/tbb/parallel_for.h>

namespace lobelia {

std::string cell_id(const Grid& grid, std::span<const ValueIndex> at) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < at.size(); ++i) length += grid.axes[i].values[at[i]].token.size() + 1;
  std::string id;
  id.reserve(length);
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (i > 0) id += '-';
    id += grid.axes[i].values[at[i]].token;
  }
  return id;
}

std::vector<Cell> cells_of(const Grid& grid) {
  const std::size_t width = grid.axes.size();
  std::vector<Cell> cells(grid.cell_count());
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t c) {
    const std::span at(grid.places.data() + c * width, width);
    Cell& cell = cells[c];
    cell.id = cell_id(grid, at);
    cell.at.assign(at.begin(), at.end());
    cell.axes.reserve(width);
    for (std::size_t i = 0; i < width; ++i) {
      const Axis& axis = grid.axes[i];
      cell.axes.emplace_back(axis.name, axis.values[at[i]].value);
      if (axis.name == "engine") cell.engines = {axis.values[at[i]].value};
    }
    if (cell.engines.empty()) cell.engines = grid.engines;
  });
  return cells;
}

Scene scene_of(const Grid& grid, const Cell& cell) {
  const auto value = [&](std::size_t i) -> const AxisValue& {
    return grid.axes[i].values[cell.at[i]];
  };
  const Scene* start = &grid.scene;
  for (std::size_t i = 0; i < cell.at.size(); ++i)
    if (value(i).scene) start = value(i).scene.get();
  Scene scene = *start;
  for (std::size_t i = 0; i < cell.at.size(); ++i)
    if (value(i).apply) value(i).apply(scene);
  return scene;
}

}  // namespace lobelia
