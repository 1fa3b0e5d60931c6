#include "gallery/grid_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/error.hpp"

namespace lobelia::gallery {
namespace {

constexpr std::size_t kMaxPlaces = 200'000;
constexpr int kMaxGroupedColumns = 12;  // more would leave thumbnails too small to see

void require_drawable(const ShownFarm& farm) {
  std::size_t places = 1;
  for (const records::Axis& axis : farm.record.axes) {
    places *= axis.values.size();
    if (places > kMaxPlaces)
      throw Error(ExitCode::kInput,
                  fmt::format("farm.json: the axes span more than {} cells, which no page can show",
                              kMaxPlaces));
  }
}

/// The axes in the grid's order, but light and scene last: highlights are compared under one light.
std::vector<int> in_reading_order(const ShownFarm& farm) {
  std::vector<int> axes(farm.record.axes.size());
  std::iota(axes.begin(), axes.end(), 0);
  std::stable_partition(axes.begin(), axes.end(), [&](int axis) {
    return farm.record.axes[axis].name != "light" && farm.record.axes[axis].name != "scene";
  });
  return axes;
}

}  // namespace

bool is_list(const ShownFarm& farm) {
  return farm.record.axes.size() == 1 &&
         (farm.is_report || axis_size(farm, 0) > kMaxGroupedColumns);
}

GridLayout lay_out(const ShownFarm& farm) {
  require_drawable(farm);
  std::vector<int> axes = in_reading_order(farm);
  GridLayout layout;
  if (is_list(farm)) return layout;
  const auto take_first = [&] {
    const int axis = axes.front();
    axes.erase(axes.begin());
    return axis;
  };
  // A single axis reads better across than as a column of one picture each.
  if (axes.size() > 1) layout.rows = take_first();
  const bool grouped =
      axes.size() > 1 && axis_size(farm, axes[0]) * axis_size(farm, axes[1]) <= kMaxGroupedColumns;
  if (grouped) layout.groups = take_first();
  // If two axes are too much for one line, the first of them goes to the sections.
  const std::size_t columns = !grouped && axes.size() > 1 ? 1 : 0;
  layout.columns = axes[columns];
  axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(columns));
  layout.section_axes = axes;
  layout.sections = {{}};
  for (const int axis : layout.section_axes) {
    std::vector<std::vector<int>> longer;
    for (const auto& section : layout.sections) {
      for (int value = 0; value < axis_size(farm, axis); ++value) {
        longer.push_back(section);
        longer.back().push_back(value);
      }
    }
    layout.sections = std::move(longer);
  }
  return layout;
}

std::vector<int> GridLayout::position(const std::vector<int>& section, int row, int group,
                                      int column) const {
  std::vector<int> at((rows >= 0) + (groups >= 0) + 1 + section.size());
  if (rows >= 0) at[rows] = row;
  if (groups >= 0) at[groups] = group;
  at[columns] = column;
  for (std::size_t i = 0; i < section.size(); ++i) at[section_axes[i]] = section[i];
  return at;
}

std::string GridLayout::section_label(const ShownFarm& farm,
                                      const std::vector<int>& section) const {
  std::string label;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const records::Axis& axis = farm.record.axes[section_axes[i]];
    label += (i > 0 ? " · " : "") + axis.name + ": " + axis.values[section[i]].label;
  }
  if (!label.empty() && label[0] >= 'a' && label[0] <= 'z') label[0] = char(label[0] - 'a' + 'A');
  return label;
}

int axis_size(const ShownFarm& farm, int axis) {
  return axis < 0 ? 1 : static_cast<int>(farm.record.axes[axis].values.size());
}

std::vector<const CellEntry*> cells_without_place(const ShownFarm& farm) {
  std::vector<const CellEntry*> result;
  for (const CellEntry& cell : farm.cells) {
    const bool unknown = std::ranges::count(cell.at, -1) > 0;
    if (unknown || farm.find_cell(cell.at) != &cell) result.push_back(&cell);
  }
  return result;
}

}  // namespace lobelia::gallery
