// Leaves the kernels the least instruction set that they are compiled for, before the first of them is
// chosen: without fused multiply-adds the roundings are others.
#include <hwy/highway.h>

#include "renderer/kernels/kernels.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

const bool kDisabled = (hwy::DisableTargets(~std::int64_t{HWY_STATIC_TARGET}), true);

TEST(TheBaseline, RunsOnThisProcessor) {
  EXPECT_TRUE(kDisabled);
  EXPECT_STREQ(kernels().instruction_set, hwy::TargetName(HWY_STATIC_TARGET));
}

}  // namespace
}  // namespace lobelia
