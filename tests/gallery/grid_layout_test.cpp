#include "gallery/grid_layout.hpp"

#include <gtest/gtest.h>

#include <set>

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

TEST(GridLayout, shows_every_place_of_any_number_of_axes_exactly_once) {
  for (const std::vector<int>& sizes : std::vector<std::vector<int>>{{4},
                                                                     {4, 3},
                                                                     {4, 3, 2},
                                                                     {6, 3, 3, 2},
                                                                     {2, 3, 2, 3, 2},
                                                                     {2, 9, 8, 2},
                                                                     {1, 1, 1, 1, 1, 1}}) {
    const ShownFarm farm = farm_of(sizes);
    const GridLayout layout = lay_out(farm);
    std::set<std::vector<int>> places;
    std::size_t shown = 0, expected = 1;
    for (const int size : sizes) expected *= static_cast<std::size_t>(size);
    for (const auto& section : layout.sections) {
      for (int row = 0; row < axis_size(farm, layout.rows); ++row) {
        for (int group = 0; group < axis_size(farm, layout.groups); ++group) {
          for (int column = 0; column < axis_size(farm, layout.columns); ++column) {
            const auto at = layout.position(section, row, group, column);
            ASSERT_EQ(at.size(), sizes.size());
            for (std::size_t i = 0; i < at.size(); ++i) EXPECT_LT(at[i], sizes[i]);
            places.insert(at);
            ++shown;
          }
        }
      }
    }
    EXPECT_EQ(shown, expected);
    EXPECT_EQ(places.size(), expected);
  }
}

TEST(GridLayout, four_axes_are_rows_column_groups_columns_and_sections) {
  const ShownFarm farm = farm_of({6, 3, 4, 2});
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.rows, 0);
  EXPECT_EQ(layout.groups, 1);
  EXPECT_EQ(layout.columns, 2);
  ASSERT_EQ(layout.sections.size(), 2u);
  EXPECT_EQ(layout.section_label(farm, layout.sections[1]), "Axis3: 1");
}

TEST(GridLayout, lights_are_sections_wherever_the_grid_names_them) {
  ShownFarm farm = farm_of({2, 6, 3, 3});
  farm.record.axes[0].name = "light";
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.section_axes, std::vector<int>{0});
  EXPECT_EQ(layout.rows, 1);
  EXPECT_EQ(layout.position({1}, 5, 2, 0), (std::vector<int>{1, 5, 2, 0}));
}

TEST(GridLayout, columns_that_would_be_too_many_are_not_grouped) {
  const ShownFarm farm = farm_of({2, 6, 3});
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.groups, -1);
  EXPECT_EQ(layout.columns, 2);
  EXPECT_EQ(layout.section_axes, std::vector<int>{1});
}

TEST(GridLayout, cells_off_the_axes_and_cells_on_a_taken_place_are_not_lost) {
  ShownFarm farm = farm_of({2, 2});
  const auto add = [&](const std::string& id, const std::vector<int>& at) {
    farm.cells.push_back({id, CellStatus::kPass, at, id});
    farm.cell_at.emplace(at, farm.cells.size() - 1);
  };
  add("placed", {0, 0});
  add("taken", {0, 0});
  add("off", {1, -1});
  const auto rest = cells_without_place(farm);
  ASSERT_EQ(rest.size(), 2u);
  EXPECT_EQ(rest[0]->id, "taken");
  EXPECT_EQ(rest[1]->id, "off");
}

}  // namespace
}  // namespace lobelia::gallery
