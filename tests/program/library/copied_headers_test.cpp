// The headers that people copy give what the library gives, as far as they promise. tests/program/library/copied_headers compiles
// each alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/compare.hpp"
#include "compare/metrics/flip_error.hpp"
#include "program/library/lobelia/flip_highlight.hpp"
#include "program/library/lobelia/highlight.hpp"
#include "renderer/highlight.hpp"

namespace lobelia {
namespace {

constexpr double kExponents[] = {0, 1e-3, 0.7, 1, 5, 15.9, 16, 64, 333.3, 1024, 1e5, 1e8};

/// visit(lobe) with each of the header's.
template <class... Ls, class Visit>
void for_lobes(std::tuple<Ls...>*, const LobeId& id, double exponent, const Visit& visit) {
  const auto visit_one = [&]<class L>() {
    if (family(id) == L::kName) visit(L(highlight::LobeParameters(exponent, id.order)));
    return family(id) == L::kName;
  };
  EXPECT_EQ((int(visit_one.template operator()<Ls>()) + ...), 1) << info(id).name;
}

/// visit(library's, lobe of the header) for each lobe of the catalogue at each exponent.
template <class Visit>
void for_all_lobes(const Visit& visit) {
  for (const LobeId& id : all_lobes())
    for (const double exponent : kExponents) {
      SCOPED_TRACE(testing::Message() << info(id).name << ", n = " << exponent);
      for_lobes(static_cast<highlight::Lobes*>(nullptr), id, exponent,
                [&](const auto& lobe) { visit(id, exponent, lobe); });
    }
}

TEST(HighlightHeader, HasEveryLobeToItsPromise) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for_all_lobes([&](const LobeId& id, double exponent, const auto& lobe) {
    const Float32Error allowed = lobe_float32_error(id, exponent);
    for (int i = 0; i < 200; ++i) {
      // Over the peak and its foot, and beyond the horizon.
      const float s = i == 0   ? 0
                      : i < 20 ? float(2 * uniform(random))
                               : float(std::min(2.0, -std::log(uniform(random)) * 4 / exponent));
      const double truth = lobe_value(id, double(s), exponent);
      EXPECT_NEAR(lobe.value(double(s)), truth, 1e-12) << s;
      if (truth < double(std::numeric_limits<float>::min())) continue;
      const double ulps = allowed.ulp - allowed.ulp_per_nat * std::log(truth);
      EXPECT_NEAR(double(lobe.value(s)), truth, allowed.of_peak + ulps * truth * 0x1p-23) << s;
    }
  });
}

template <class... Ms, class L>
void expect_coefficients(std::tuple<Ms...>*, const LobeId& id, double exponent, const L&) {
  const auto expect_one = [&]<class M>() {
    const Highlight same{find_model(M::kName).value(), id, Normalisation::kExact, exponent};
    const highlight::Highlight<M, L> copied(exponent, id.order);
    const double truth = radiance_coefficient(same);
    EXPECT_NEAR(copied.coefficient() / truth, 1, 1e-12) << M::kName;
    const highlight::Vector3<double> normal{0, 0, 1}, to_eye{0.48, 0.6, 0.64},
        to_light{-0.6, -0.48, 0.64};
    const double s = highlight::one_minus_cos<M::kAngle, double>(normal, to_eye, to_light);
    EXPECT_EQ(info(same.model).angle == LobeAngle::kReflection,
              M::kAngle == highlight::LobeAngle::kReflection);
    EXPECT_NEAR(copied.radiance(normal, to_eye, to_light), highlight_radiance(same, 0.64, 0.64, s),
                2e-12 * highlight_radiance(same, 0.64, 0.64, 0))
        << M::kName;
    EXPECT_EQ(copied.radiance_at(-0.1f, 0.5f, 0.0f), 0);
  };
  EXPECT_EQ(sizeof...(Ms), all_models().size());
  (expect_one.template operator()<Ms>(), ...);
}

TEST(HighlightHeader, HasEveryCoefficientToItsPromise) {
  for_all_lobes([](const LobeId& id, double exponent, const auto& lobe) {
    expect_coefficients(static_cast<highlight::Models*>(nullptr), id, exponent, lobe);
  });
}

/// A bright spot, now and then over light or with a firefly, and another that hardly or clearly differs from it.
struct RandomPair {
  explicit RandomPair(unsigned seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double change = std::exp2(between(-9, -1)), peak = std::exp2(between(-3, 5));
    const double x = between(15, 45), y = between(15, 35), narrow = between(0.01, 0.2);
    const double ground = seed % 3 == 0 ? between(0, 0.3) * peak : 0;
    const double tint[] = {between(0.3, 1), between(0.3, 1), between(0.3, 1)};
    const auto draw = [&](Image& image, double off) {
      const double bright = peak * (1 + off * between(-1, 1)),
                   sharp = narrow * (1 + off * between(-1, 1)), left = x + 8 * off * between(-1, 1),
                   top = y + 8 * off * between(-1, 1);
      for (int row = 0; row < image.height(); ++row)
        for (int column = 0; column < image.width(); ++column)
          for (std::size_t c = 0; c < 3; ++c)
            image.pixel(column, row)[c] =
                float(tint[c] * (ground + bright * std::exp(-sharp * (std::pow(column - left, 2) +
                                                                      std::pow(row - top, 2)))));
      if (seed % 7 == 0 && off > 0) image.pixel(3, 3)[1] = float(3 * peak);
    };
    draw(a, change);
    draw(b, 0);
  }
  Image a{61, 50}, b{61, 50};
};

flip_highlight::Image view(const Image& image) {
  return {image.width(), image.height(), image.values().data()};
}

TEST(FlipHighlightHeader, GivesTheVerdictOfTheLibrary) {
  int passed = 0, differed = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    const RandomPair pair(seed);
    ComparisonOptions options = usual_options();
    options.default_limits = false;
    const flip_highlight::Verdict copied = flip_highlight::compare(view(pair.a), view(pair.b));
    for (const auto& one : copied.limits) options.limits.push_back({one.metric, one.limit});
    const Comparison library = compare(pair.a, pair.b, options);
    EXPECT_EQ(copied.pass, library.verdict == Verdict::kPass) << seed;
    ASSERT_EQ(library.limits.size(), copied.limits.size());
    for (std::size_t i = 0; i < copied.limits.size(); ++i) {
      EXPECT_EQ(library.limits[i].metric, copied.limits[i].metric);
      EXPECT_NEAR(library.limits[i].value, copied.limits[i].value, 1e-9)
          << seed << library.limits[i].metric;
      EXPECT_EQ(library.limits[i].pass, copied.limits[i].pass) << seed << library.limits[i].metric;
    }
    ++(copied.pass ? passed : differed);
  }
  EXPECT_GT(passed, 20);
  EXPECT_GT(differed, 20);
}

TEST(FlipHighlightHeader, HasTheDefaultLimits) {
  const RandomPair pair(1);
  for (const auto& one : flip_highlight::compare(view(pair.a), view(pair.b)).limits) {
    std::vector<MetricLimit> all(default_limits().begin(), default_limits().end());
    all.insert(all.end(), highlight_limits().begin(), highlight_limits().end());
    EXPECT_THAT(all,
                testing::Contains(testing::AllOf(testing::Field(&MetricLimit::metric, one.metric),
                                                 testing::Field(&MetricLimit::limit, one.limit))));
  }
}

TEST(FlipHighlightHeader, GivesFlipInEachPixel) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const RandomPair pair(seed);
    const double stops = seed % 4 - 2.0,
                 pixels_per_degree = seed % 5 == 0 ? 20 : kDefaultPixelsPerDegree;
    const PixelValues library = flip_error_map(
        DisplayLight(pair.a, stops), DisplayLight(pair.b, stops), FlipFilters(pixels_per_degree));
    const std::vector<float> copied =
        flip_highlight::flip(view(pair.a), view(pair.b), stops, pixels_per_degree);
    ASSERT_EQ(copied.size(), library.size());
    for (std::size_t i = 0; i < copied.size(); ++i)
      ASSERT_NEAR(copied[i], library[i], 2e-6) << seed << ' ' << i;
  }
}

TEST(FlipHighlightHeader, DoesNotPassWhatIsNotFinite) {
  RandomPair pair(1);
  EXPECT_TRUE(flip_highlight::compare(view(pair.b), view(pair.b)).pass);
  pair.a = pair.b;
  pair.a.pixel(1, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(flip_highlight::compare(view(pair.a), view(pair.b)).pass);
  EXPECT_THROW(flip_highlight::flip({61, 49, pair.a.values().data()}, view(pair.b)),
               std::invalid_argument);
}

}  // namespace
}  // namespace lobelia
