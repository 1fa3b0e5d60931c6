#include "studies/accuracy/lobe_candidates.hpp"
#include "tests/test.hpp"

namespace lobelia::accuracy {
namespace {

TEST(HighlightDifference, IsTheLargestOfAFineGridForEveryPairOfLobes) {
  for (const ModelId model : all_models())
    for (const double exponent : {0.1, 1.0, 7.0, 64.0, 1e4, 1e7})
      for (const LobeId& a : all_lobes())
        for (const LobeId& b : {*find_lobe("cosine"), *find_lobe("schlick"), *find_lobe("cs4")}) {
          const Highlight stand_in{model, a, Normalisation::kExact, exponent};
          const Highlight target{model, b, Normalisation::kExact, exponent};
          const double ratio = radiance_coefficient(stand_in) / radiance_coefficient(target);
          const auto difference = [&](double s) {
            return std::abs(ratio * lobe_value(a, s, exponent) - lobe_value(b, s, exponent));
          };
          double most = 0;
          // Fine at the peak, in the tail, and where lobes of small n end steeply.
          for (int i = 0; i <= 5000; ++i) {
            const double part = i / 5000.0, square = part * part;
            for (const double s : {square, std::min(1.0, 40 / exponent * square)})
              most = std::max(most, difference(s));
          }
          for (double gap = 1; gap > 1e-17; gap /= 2) most = std::max(most, difference(1 - gap));
          const double found = highlight_difference(stand_in, target);
          SCOPED_TRACE(::testing::Message()
                       << info(a).name << " for " << info(b).name << ", n = " << exponent);
          EXPECT_GE(1.01 * found + 1e-14, most);
          EXPECT_LE(found, 1.01 * most + 1e-3);
          if (a == b) {
            EXPECT_EQ(found, 0);
          }
        }
}

TEST(HighlightDifference, IsOfTheCoefficientToo) {
  const ModelId model = *find_model("phong_rdf");
  const Highlight exact{model, *find_lobe("cs16"), Normalisation::kExact, 64};
  Highlight paper = exact;
  paper.normalisation = Normalisation::kPaper;
  const double ratio = radiance_coefficient(exact) / radiance_coefficient(paper);
  EXPECT_NEAR(highlight_difference(exact, paper), std::abs(ratio - 1), 1e-12);
  EXPECT_GT(std::abs(ratio - 1), 1e-5);
}

}  // namespace
}  // namespace lobelia::accuracy
