#include "farm_fixture.hpp"
#include "tests/base/unflushed_names.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST_F(FarmTest, FlushesEachResultBeforeItsName) {
  const Grid some = grid("16, 32", "<engine name=\"analytic\"/>");
  const unflushed::Watch watch;
  EXPECT_EQ(run_farm(some, out(), {}).cells, 2u);
  EXPECT_GT(unflushed::flushes, 0);
  // Files in a draft may get their names early. The whole draft is flushed before it becomes a result.
  for (const std::string& name : unflushed::names)
    EXPECT_TRUE(name.ends_with(".part") && name.find("cell.json") == name.npos) << name;
}

}  // namespace
}  // namespace lobelia
