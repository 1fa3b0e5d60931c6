// The arithmetic of lobes and models, against a count by hand.
#include "renderer/operation_count.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(OperationCount, CountsLog2OfKSquaringsForCsK) {
  int squarings = 1;
  for (const int k : {2, 4, 8, 16, 32, 64, 128})
    EXPECT_EQ(operations(*find_lobe("cs" + std::to_string(k))).multiply, 1 + squarings++) << k;
  // u^12 = (u^4)^2 u^4: three squarings and a product.
  EXPECT_EQ(operations(*find_lobe("cs12")).multiply, 1 + 4);
  // One multiply-add, and one comparison that cuts the base at 0.
  EXPECT_EQ(operations(*find_lobe("cs16")), (OperationCount{5, 1, 0, 0, 0, 1}));
}

TEST(OperationCount, CountsSomethingForEveryLobeAndModel) {
  for (const LobeId& lobe : all_lobes()) EXPECT_GT(operations(lobe).multiply, 0);
  for (const ModelId model : all_models()) {
    const OperationCount count = operations(model);
    EXPECT_GT(count.multiply, 6) << info(model).name;
    // The half vector is of unit length after a root and a division. Shadowing is a quotient with two roots.
    const int unit = info(model).angle == LobeAngle::kHalfVector ? 1 : 0;
    const int shadowing = info(model).has_shadowing ? 1 : 0;
    EXPECT_EQ(count.root, unit + 2 * shadowing) << info(model).name;
    EXPECT_EQ(count.divide, unit + shadowing) << info(model).name;
  }
}

}  // namespace
}  // namespace lobelia
