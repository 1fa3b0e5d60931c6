// sample() draws as pdf() says, for every model and lobe, from normal incidence to grazing.
#include "tests/more_samples.hpp"
#include "tests/renderer/laws/chi_square.hpp"

namespace lobelia {
namespace {

constexpr double kSampledIncidences[] = {0, 30, 60, 85, 89.9};

/// The highlight alone, or half hidden in a diffuse base and growing towards grazing.
Material material(const Highlight& h, bool with_base) {
  return with_base ? Material{"", h, {0.3, 0.2, 0.1}, {0.5, 0.4, 0.3}, Fresnel::kSchlick}
                   : Material{"", h, {1, 1, 1}, {}};
}

/// The level of one test at which one of `tests` that are all right fails with a probability of 1 % in all (Sidak).
double significance(std::size_t tests) { return 1 - std::pow(1 - 0.01, 1.0 / double(tests)); }

void expect_draws_as_the_pdf_says(const std::vector<Highlight>& cases, bool with_base) {
  const double limit = significance(2 * cases.size() * std::size(kSampledIncidences));
  std::uint64_t seed = 1;
  for (const Highlight& h : cases)
    for (const double degrees : kSampledIncidences) {
      if (is_left_out(seed++, 11)) continue;
      const Reflector reflector(material(h, with_base));
      const ChiSquare test(reflector, reflector, info(h.model).angle, radians(degrees), seed);
      EXPECT_GT(test.p_value(), limit) << text(h) << " at " << degrees << " degrees";
      EXPECT_LE(test.probability_of_light(), 1 + 1e-3) << text(h) << " at " << degrees;
    }
}

TEST(EverySampler, DrawsAHighlightAsOftenAsItsPdfSays) {
  expect_draws_as_the_pdf_says(highlights(every_model(), kSampledExponents), false);
}

TEST(EverySampler, DrawsDirectionsAsOftenAsItsPdf) {
  expect_draws_as_the_pdf_says(highlights(every_model(), kSampledExponents), true);
}

TEST(EverySampler, DrawsABlackSurfaceEvenly) {
  for (const Highlight& h : highlights(every_model(), std::array{16.0})) {
    Material black = material(h, false);
    black.specular_reflectance = {};
    const Reflector reflector(black);
    const Vec3 normal{0, 0, 1}, to_eye = normalize({0.6, 0, 0.8});
    for (const double u : {0.1, 0.5, 0.9}) {
      const auto drawn = reflector.sample(normal, to_eye, 0.5, u, 0.3);
      ASSERT_TRUE(drawn) << text(h);
      const double expected = drawn->to_light.z / std::numbers::pi;
      EXPECT_NEAR(drawn->pdf, expected, 1e-12) << text(h);
      EXPECT_NEAR(reflector.pdf(normal, to_eye, drawn->to_light), expected, 1e-12) << text(h);
    }
  }
}

}  // namespace
}  // namespace lobelia
