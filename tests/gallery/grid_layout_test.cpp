#include "gallery/grid_layout.hpp"

#include <gtest/gtest.h>

namespace lobelia::gallery {
namespace {

ShownFarm farm_of(const std::vector<int>& sizes) {
  ShownFarm farm;
  for (const int size : sizes) {
    records::Axis axis{"axis" + std::to_string(farm.record.axes.size()), {}};
    for (int i = 0; i < size; ++i) axis.values.push_back({std::to_string(i), std::to_string(i)});
    farm.record.axes.push_back(std::move(axis));
  }
  return farm;
}

TEST(GridLayout, four_axes_are_rows_column_groups_columns_and_sections) {
  const ShownFarm farm = farm_of({6, 3, 4, 2});
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.rows, 0);
  EXPECT_EQ(layout.groups, 1);
  EXPECT_EQ(layout.columns, 2);
}

TEST(GridLayout, lights_are_sections_wherever_the_grid_names_them) {
  ShownFarm farm = farm_of({2, 6, 3, 3});
  farm.record.axes[0].name = "light";
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.rows, 1);
  EXPECT_EQ(layout.groups, 2);
  EXPECT_EQ(layout.columns, 3);
}

TEST(GridLayout, columns_that_would_be_too_many_are_not_grouped) {
  const ShownFarm farm = farm_of({2, 6, 3});
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.groups, -1);
  EXPECT_EQ(layout.columns, 2);
}

}  // namespace
}  // namespace lobelia::gallery
