#include <gmock/gmock.h>

#include "farm_fixture.hpp"
#include "tests/core/unflushed_names.hpp"

namespace lobelia {
namespace {

TEST_F(FarmTest, GivesNoResultAndNoRecordItsNameBeforeTheyAreFlushed) {
  const Grid some = grid("16, 32", "<engine name=\"analytic\"/>");
  const unflushed::Watch watch;
  EXPECT_EQ(run_farm(some, out(), {}).cells, 2u);
  EXPECT_THAT(unflushed::names, testing::IsEmpty());
  EXPECT_GT(unflushed::flushes, 0);
}

}  // namespace
}  // namespace lobelia
