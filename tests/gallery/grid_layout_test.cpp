#include "gallery/pages/grid_layout.hpp"
#include "tests/test.hpp"

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

TEST(GridLayout, MakesRowsColumnGroupsColumnsAndSectionsOfFourAxes) {
  const ShownFarm farm = farm_of({6, 3, 4, 2});
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.rows, 0);
  EXPECT_EQ(layout.groups, 1);
  EXPECT_EQ(layout.columns, 2);
}

TEST(GridLayout, MakesSectionsOfLightsWhereverTheGridNamesThem) {
  ShownFarm farm = farm_of({2, 6, 3, 3});
  farm.record.axes[0].name = "light";
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.rows, 1);
  EXPECT_EQ(layout.groups, 2);
  EXPECT_EQ(layout.columns, 3);
}

TEST(GridLayout, GroupsNoColumnsThatWouldBeTooMany) {
  const ShownFarm farm = farm_of({2, 6, 3});
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.groups, -1);
  EXPECT_EQ(layout.columns, 2);
}

}  // namespace
}  // namespace lobelia::gallery
