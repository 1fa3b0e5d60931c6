// The catalogue as `lobelia models --json` has it.
#include "renderer/catalogue_record.hpp"
#include "renderer/operation_count.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// Everything that holds a number must hold a finite one.
void expect_finite(const Json& json) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_structured()) expect_finite(value);
    if (value.is_number()) {
      EXPECT_TRUE(std::isfinite(value.get<double>())) << key;
    }
  }
}

const Json& find(const Json& list, std::string_view name) {
  for (const Json& entry : list)
    if (entry.at("name") == name) return entry;
  throw std::runtime_error(std::string(name) + " is not in the catalogue");
}

TEST(CatalogueRecord, HasEveryModelLobeAndTheirCombinationsMeasured) {
  const Json record = as_json(catalogue_record(64));
  EXPECT_EQ(record.at("models").size(), all_models().size());
  EXPECT_EQ(record.at("lobes").size(), all_lobes().size());
  // Two lobes have a coefficient of the paper beside the exact one.
  EXPECT_EQ(record.at("highlights").size(), all_models().size() * (all_lobes().size() + 2));
  expect_finite(record);
  for (const Json& parameter : record.at("parameters"))
    EXPECT_TRUE(parameter.contains("allowed") || parameter.contains("max")) << parameter.dump();
}

TEST(CatalogueRecord, KnowsTheHalfWidthAndTheSupportOfALobe) {
  const LobeId lobes[] = {*find_lobe("cosine"), *find_lobe("cs16"), *find_lobe("schlick")};
  const Json record = as_json(catalogue_record(100, lobes));
  const double degree = std::numbers::pi / 180;
  // cos^n is a half at arccos(2^(-1/n)); cs_k is 0 from 1 - cos = k/n on.
  EXPECT_NEAR(find(record.at("lobes"), "cosine").at("halfWidthDegrees").get<double>(),
              std::acos(std::exp2(-0.01)) / degree, 1e-9);
  EXPECT_NEAR(find(record.at("lobes"), "cs16").at("supportDegrees").get<double>(),
              std::acos(0.84) / degree, 1e-2);
  EXPECT_NEAR(find(record.at("lobes"), "schlick").at("supportDegrees").get<double>(), 90, 1e-6);
  // Bernoulli's inequality: below cos^n and never above; Schlick's tail is above everywhere.
  EXPECT_LT(find(record.at("lobes"), "cs16").at("aboveCosine").get<double>(), 1e-14);
  EXPECT_GT(find(record.at("lobes"), "cs16").at("belowCosine").get<double>(), 1e-3);
  EXPECT_GT(find(record.at("lobes"), "schlick").at("aboveCosine").get<double>(), 0.1);
}

// The arithmetic of lobes and models, against a count by hand.

TEST(OperationCount, CountsLog2OfKSquaringsForCsK) {
  int squarings = 1;
  for (const int k : {2, 4, 8, 16, 32, 64, 128})
    EXPECT_EQ(operations(*find_lobe("cs" + std::to_string(k))).multiply, squarings++) << k;
  // u^12 = (u^4)^2 u^4: three squarings and a product.
  EXPECT_EQ(operations(*find_lobe("cs12")).multiply, 4);
  // One multiply-add, and one comparison that cuts the base at 0.
  EXPECT_EQ(operations(*find_lobe("cs16")), (OperationCount{1, 4, 0, 0, 0, 0, 1}));
}

TEST(OperationCount, CountsSomethingForEveryLobeAndModel) {
  for (const LobeId& lobe : all_lobes()) EXPECT_GT(price(lobe), 0);
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
