#include "gallery/pages/grid_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/system/error.hpp"

namespace lobelia::gallery {
namespace {

constexpr std::size_t kMaxPlaces = 200'000;
constexpr int kMaxGroupedColumns = 12;  // more would leave thumbnails too small to see

/// Number of values, or 1 where there is no such axis.
int axis_size(const ShownFarm& farm, int axis) {
  return axis < 0 ? 1 : static_cast<int>(farm.record.axes[axis].values.size());
}

/// A single axis that is too long for a line.
bool is_list(const ShownFarm& farm) {
  return farm.record.axes.size() == 1 &&
         (farm.is_report || axis_size(farm, 0) > kMaxGroupedColumns);
}

void require_drawable(const ShownFarm& farm) {
  std::size_t places = 1;
  for (const records::Axis& axis : farm.record.axes) {
    places *= axis.values.size();
    if (places > kMaxPlaces)
      throw Error(ExitCode::kInput,
                  "farm.json: the axes span more than {} cells, which no page can show",
                  kMaxPlaces);
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
  return layout;
}

}  // namespace lobelia::gallery
