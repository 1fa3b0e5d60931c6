// eval, sample and pdf of a Reflector belong to each other, for every model and lobe, from normal incidence to grazing.
#include <boost/math/distributions/normal.hpp>

#include "renderer/albedo.hpp"
#include "renderer/reflector.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/laws/directions.hpp"

namespace lobelia {
namespace {

constexpr double kSomeIncidences[] = {0, 30, 60, 85, 89.9};

TEST(EverySampler, DrawsABlackSurfaceEvenly) {
  for (const Highlight& h : highlights(every_model(), std::array{16.0})) {
    const Reflector reflector({"", h, {}, {}});
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

TEST(EverySample, HasItsStatedRadianceAtItsStatedPdf) {
  const Frame frame;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Highlight& h : highlights(every_model(), kExponents)) {
    const Reflector reflector({"", h, {0.5, 0.4, 0.3}, {0.3, 0.2, 0.1}, Fresnel::kSchlick});
    int drawn = 0;
    for (const double degrees : kSomeIncidences)
      for (int i = 0; i < 20; ++i) {
        const Vec3 to_eye = frame(radians(degrees), uniform(random));
        const auto sample = reflector.sample(frame.normal, to_eye, uniform(random), uniform(random),
                                             uniform(random));
        if (!sample) continue;
        ++drawn;
        EXPECT_NEAR(length(sample->to_light), 1, 1e-15);
        EXPECT_GT(dot(frame.normal, sample->to_light), 0);
        EXPECT_GT(sample->pdf, 0);
        const Rgb radiance = reflector.eval(frame.normal, to_eye, sample->to_light);
        const double pdf = reflector.pdf(frame.normal, to_eye, sample->to_light);
        // 1.1e-9 for the rounding of a direction to a lobe 1e-4 wide, at grazing.
        EXPECT_NEAR(sample->radiance.r, radiance.r, 1e-8 * radiance.r) << text(h);
        EXPECT_NEAR(sample->pdf, pdf, 1e-8 * pdf) << text(h);
      }
    EXPECT_GT(drawn, 20) << text(h);
  }
}

TEST(EverySample, IsNothingOrFiniteAtTheEndsOfItsRandomNumbers) {
  const Frame frame;
  constexpr double kLast = 1 - 0x1p-53;
  for (const Highlight& h : highlights(every_model(), kExponents)) {
    const Reflector reflector({"", h, {1, 1, 1}, {1, 1, 1}});
    for (const double degrees : kSomeIncidences)
      for (const double choice : {0.0, kLast})
        for (const double u : {0.0, 0x1p-53, kLast})
          for (const double v : {0.0, kLast})
            if (const auto sample =
                    reflector.sample(frame.normal, frame(radians(degrees), 1), choice, u, v)) {
              EXPECT_TRUE(std::isfinite(sample->pdf) && sample->pdf > 0) << text(h);
              EXPECT_TRUE(std::isfinite(sample->radiance.r) && sample->radiance.r >= 0) << text(h);
            }
  }
}

/// With a diffuse base, too: a pdf that is not that of the draws, or weighs the two wrongly, misses the sum.
TEST(EverySampler, EstimatesTheDirectionalAlbedo) {
  const Frame frame;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto cases = highlights(every_model(), kSampledExponents);
  const double tests = double(2 * cases.size() * std::size(kSomeIncidences));
  // One of the tests fails by chance with the probability 0.01.
  const double sigmas =
      boost::math::quantile(boost::math::normal(), 1 - (1 - std::pow(0.99, 1 / tests)) / 2);
  std::size_t number = 0;
  for (const Highlight& h : cases)
    for (const double degrees : kSomeIncidences)
      for (const double base : {0.0, 0.3}) {
        if (is_left_out(number++, 7)) continue;
        const Reflector reflector({"", h, {1, 1, 1}, {base, base, base}});
        const Vec3 to_eye = frame(radians(degrees), 1);
        constexpr int kDraws = 10000;
        double sum = 0, sum_of_squares = 0, largest = 0;
        for (int i = 0; i < kDraws; ++i) {
          const double choice = uniform(random), u = uniform(random), v = uniform(random);
          const auto sample = reflector.sample(frame.normal, to_eye, choice, u, v);
          const double weight = sample ? sample->radiance.r / sample->pdf : 0;
          sum += weight;
          sum_of_squares += weight * weight;
          largest = std::max(largest, weight);
        }
        const double mean = sum / kDraws;
        const double sigma =
            std::sqrt(std::max(0.0, sum_of_squares / kDraws - mean * mean) / kDraws);
        // Ten draws for what is so rare, a light below the horizon, that the deviation does not know it.
        EXPECT_NEAR(mean, directional_albedo(h, radians(degrees)) + base,
                    sigmas * sigma + 10 * largest / kDraws)
            << text(h) << " at " << degrees << " over " << base;
      }
}

}  // namespace
}  // namespace lobelia
