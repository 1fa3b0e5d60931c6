// FilterSampler draws from what it says it draws from.
#include "renderer/filter.hpp"

#include <fmt/format.h>

#include "base/system/files.hpp"
#include "lobelia_paths.hpp"
#include "renderer/filters.hpp"
#include "renderer/peak_bound.hpp"
#include "renderer/plan/effects/catalogue.hpp"
#include "renderer/render.hpp"
#include "renderer/sobol.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// Calls check(filter, value of the filter at an offset in radii) for every filter of the catalogue.
template <class Check, class... Fs>
int for_each_filter(TypeList<Fs...>, Check check) {
  (check(*find_filter(Fs::kName), [](double x) { return double(Fs::value(x)); }), ...);
  return sizeof...(Fs);
}

/// Midpoint rule over [a, b] of the radius, far finer than the sampler's own steps.
template <class Function>
double integral(Function f, double a, double b) {
  constexpr int kParts = 20000;
  double sum = 0;
  for (int i = 0; i < kParts; ++i) sum += f(a + (b - a) * (i + 0.5) / kParts);
  return sum * (b - a) / kParts;
}

TEST(FilterSampler, DrawsEachPartOfAFilterAsItIsHigh) {
  const int count = for_each_filter(Filters{}, [](Filter filter, auto value) {
    SCOPED_TRACE(name(filter));
    constexpr int kBins = 32, kSide = 1 << 10;
    // For each bin along one axis: the integrals of the parts above 0 and below.
    std::vector<double> above, below;
    for (int b = 0; b < kBins; ++b) {
      const double from = -1 + 2.0 * b / kBins, to = -1 + 2.0 * (b + 1) / kBins;
      above.push_back(integral([&](double x) { return std::max(0.0, value(x)); }, from, to));
      below.push_back(integral([&](double x) { return std::max(0.0, -value(x)); }, from, to));
    }
    const FilterSampler sampler(filter);
    for (const bool negative : {false, true}) {
      if (negative && sampler.negative_weight() == 0) continue;
      std::vector<double> expected, found(kBins * kBins);
      double total = 0;
      for (int y = 0; y < kBins; ++y)
        for (int x = 0; x < kBins; ++x) {
          expected.push_back(negative ? above[x] * below[y] + below[x] * above[y]
                                      : above[x] * above[y] + below[x] * below[y]);
          total += expected.back();
        }
      const auto bin = [&](double offset) {
        return std::min(kBins - 1, int((offset / filter.radius + 1) / 2 * kBins));
      };
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
          const auto [x, y] = sampler(negative, (i + 0.5) / kSide, (j + 0.5) / kSide);
          found[bin(y) * kBins + bin(x)] += 1.0 / kSide / kSide;
        }
      // Along each axis stratified draws miss a bin's share by one of 2^10 at either end.
      for (int b = 0; b < kBins * kBins; ++b)
        EXPECT_NEAR(found[b], expected[b] / total, 2e-4) << negative << ", bin " << b;
    }
  });
  EXPECT_EQ(count, int(filter_names().size()));
}

TEST(FilterSampler, CountsTheNegativePartByItsShareOfTheFiltersIntegral) {
  for_each_filter(Filters{}, [](Filter filter, auto value) {
    const double above = integral([&](double x) { return std::max(0.0, value(x)); }, -1, 1);
    const double below = integral([&](double x) { return std::max(0.0, -value(x)); }, -1, 1);
    // 4e-9 for mitchell, 0 for the others.
    EXPECT_NEAR(FilterSampler(filter).negative_weight(),
                2 * above * below / ((above - below) * (above - below)), 1e-7)
        << name(filter);
  });
  EXPECT_GT(FilterSampler(*find_filter("mitchell")).negative_weight(), 0.07);
}

TEST(FilterSampler, GivesEachPartItsShareOfTheSamples) {
  for (const std::string_view filter_name : filter_names()) {
    const FilterSampler sampler(*find_filter(filter_name));
    const double weight = sampler.negative_weight(), share = weight / (1 + 2 * weight);
    std::uint32_t counts[2] = {};
    for (std::uint32_t k = 0; k < 5000; ++k) {
      const auto place = sampler.place(k);
      ASSERT_EQ(place.index, counts[place.negative]++) << filter_name << ", sample " << k;
      if (weight == 0) continue;
      ASSERT_EQ(counts[1] > 0, k > 0) << filter_name;
      // One more than its share at most, rounded to one of a whole number: mitchell's is 1 / 15.8.
      ASSERT_LE(std::abs(counts[1] - share * (k + 1)), 1 + 0.02 * share * (k + 1)) << k;
    }
    EXPECT_EQ(counts[1] == 0, weight == 0) << filter_name;
  }
}

double mean_by_nodes(Filter filter, double (*value)(double x, double y)) {
  double sum = 0;
  for (const FilterNode& node : filter_nodes(filter)) sum += node.weight * value(node.x, node.y);
  return sum;
}

/// By the midpoints of many small squares.
double mean_by_sums(Filter filter, double (*value)(double x, double y)) {
  constexpr int kSteps = 400;
  double sum = 0, weights = 0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const double x = 2 * (i + 0.5) / kSteps - 1, y = 2 * (j + 0.5) / kSteps - 1;
      const double weight = filter_value(filter, x) * filter_value(filter, y);
      sum += weight * value(filter.radius * x, filter.radius * y);
      weights += weight;
    }
  return sum / weights;
}

TEST(FilterNodes, GiveTheMeanOfAHighlightWithEveryFilter) {
  ASSERT_GE(filter_names().size(), 5u);
  for (const std::string_view name : filter_names()) {
    const Filter filter = find_filter(name).value();
    // The flank of a highlight of a half-width of 2.4 pixels, and a polynomial of degree 4.
    const auto flank = [](double x, double y) {
      return std::exp(-((x - 1.3) * (x - 1.3) + (y + 0.7) * (y + 0.7)) / 8);
    };
    const auto polynomial = [](double x, double y) {
      return 1 + x - 2 * y + x * y + 3 * x * x - y * y * y * y + x * x * y * y;
    };
    EXPECT_NEAR(mean_by_nodes(filter, flank), mean_by_sums(filter, flank), 2e-5) << name;
    EXPECT_NEAR(mean_by_nodes(filter, polynomial), mean_by_sums(filter, polynomial), 2e-5) << name;
  }
}

TEST(FilterNodes, AreFewAndSumToOneForEveryFilter) {
  for (const std::string_view name : filter_names())
    for (const double radius : {0.1, 0.5, 2.0, 16.0}) {
      Filter filter = find_filter(name).value();
      filter.radius = radius;
      double sum = 0;
      for (const FilterNode& node : filter_nodes(filter)) {
        sum += node.weight;
        EXPECT_LE(std::max(std::abs(node.x), std::abs(node.y)), radius) << name;
      }
      EXPECT_NEAR(sum, 1, 1e-12) << name;
      EXPECT_LE(filter_nodes(filter).size(), 16u) << name;
    }
}

// Several rays a pixel: an even sky stays even by every filter, and rays are spent only where they are needed.

/// Every filter with its own radius and with others.
std::vector<Filter> all_filters() {
  std::vector<Filter> all;
  for (const std::string_view name : filter_names()) {
    const Filter own = *find_filter(name);
    all.push_back(own);
    for (const double radius : {0.6, 1.3, 3.0, 5.5})
      if (radius != own.radius) all.push_back({own.index, radius});
  }
  return all;
}

std::string label(Filter filter) { return fmt::format("{} {}", name(filter), filter.radius); }

TEST(EveryFilter, LeavesAnEvenSkyExactlyAsItIs) {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 28};
  scene.film = {16, 16};
  scene.lights = {ConstantLight{{1, 1, 1}}};
  for (const Filter filter : all_filters())
    for (const int samples : {2, 3, 4, 5, 8, 16, 17, 31, 64}) {
      scene.film.filter = filter;
      scene.sampler.sample_count = samples;
      const Image image = render(scene, {}).image;
      const auto [least, most] = std::minmax_element(image.values().begin(), image.values().end());
      EXPECT_EQ(*least, 1.f) << label(filter) << ", " << samples << " samples";
      EXPECT_EQ(*most, 1.f) << label(filter) << ", " << samples << " samples";
      RenderOptions in_rounds;
      in_rounds.time_limit = 1e6;
      const Image rounds = render(scene, in_rounds).image;
      EXPECT_TRUE(std::all_of(rounds.values().begin(), rounds.values().end(),
                              [](float v) { return v == 1; }))
          << label(filter) << ", " << samples << " samples in rounds";
    }
}

/// Spheres with highlights, shadows and silhouettes, grey, in which a few samples tell where more are needed.
Scene random_scene(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution(a, b)(random);
  };
  Scene scene;
  // Near enough for surfaces that are nearly even from pixel to pixel, or all in view.
  scene.camera = {{0, 0, 8}, {0, 0, 0}, {0, 1, 0}, std::exp(between(1, std::log(40)))};
  scene.film = {int(between(64, 80)), int(between(32, 64))};
  const int count = 1 + int(random() % 3);
  for (int i = 0; i < count; ++i) {
    Material m = matt(random() % 2 ? between(0.05, 0.8) : 0);
    m.highlight.exponent = between(2, 8);
    const double specular = random() % 4 ? between(0.05, 1) : 0;
    m.specular_reflectance = {specular, specular, specular};
    scene.materials.push_back(m);
    scene.spheres.push_back(
        {{between(-2, 2), between(-2, 2), between(-1, 1)}, between(0.7, 1.4), i});
  }
  const double light = std::exp(between(-3, 3));
  if (random() % 2)
    scene.lights = {
        DirectionalLight{normalize({between(-1, 1), between(-1, 1), -1}), {light, light, light}}};
  else
    scene.lights = {
        PointLight{{between(-4, 4), between(-4, 4), between(4, 9)}, {light, light, light}}};
  return scene;
}

TEST(Antialiasing, GivesChosenPixelsTheValuesOfAllWithinItsThreshold) {
  constexpr int kScenes = 4;
  std::uint64_t seed = 0;
  for (const Filter filter : some_of(all_filters())) {
    int chosen = 0;
    double worst = 0;
    for (int k = 0; k < kScenes; ++k) {
      Scene scene = random_scene(++seed);
      scene.film.filter = filter;
      scene.sampler = {64, seed};
      const RenderResult some = render(scene, {});
      if (some.plan.first_samples == scene.sampler.sample_count) continue;
      ++chosen;
      EXPECT_LE(some.work.camera_rays, some.plan.camera_rays) << label(filter) << ", seed " << seed;
      RenderOptions everywhere;
      everywhere.time_limit = 1e6;  // in rounds, which choose no pixels
      const RenderResult all = render(scene, everywhere);
      const double black = effects::Antialiasing::kBlack * peak_bound(scene, scene.lights);
      for (std::size_t i = 0; i < all.image.values().size(); ++i) {
        const double expected = all.image.values()[i];
        worst =
            std::max(worst, std::abs(some.image.values()[i] - expected) /
                                std::max(effects::Antialiasing::kSame * std::abs(expected), black));
      }
    }
    EXPECT_GE(chosen, kScenes / 2) << label(filter);
    EXPECT_LE(worst, 1) << label(filter);
  }
}

TEST(Antialiasing, HasTheThresholdsOfTheConventions) {
  std::string text = read_file(std::string(LOBELIA_SOURCE_DIR) + "/docs/conventions.md", 1 << 20);
  std::replace(text.begin(), text.end(), '\n', ' ');
  using effects::Antialiasing;
  EXPECT_NE(
      text.find(fmt::format("1/{:g} of its mean and 1e{:g} of the brightest possible highlight",
                            1 / Antialiasing::kSame, std::log10(Antialiasing::kBlack))),
      std::string::npos);
  EXPECT_NE(text.find(fmt::format("it takes {} first", Antialiasing::kFirst)), std::string::npos);
}

TEST(Sobol, EveryPairOfEveryPixelIsANetForEveryPowerOfTwo) {
  for (std::uint32_t pixel = 0; pixel < 50; ++pixel)
    for (std::uint32_t dimension = 0; dimension < 4; ++dimension)
      for (int m = 0; m <= 8; ++m)
        for (int a = 0; a <= m; ++a) {
          std::vector<int> cells(std::size_t{1} << m);
          for (std::uint32_t k = 0; k < cells.size(); ++k) {
            const auto [u, v] = sobol::pair(sobol::pixel_hash(pixel, 1), k, dimension);
            ASSERT_TRUE(u >= 0 && u < 1 && v >= 0 && v < 1);
            ++cells[(std::size_t(u * (1 << a)) << (m - a)) + std::size_t(v * (1 << (m - a)))];
          }
          ASSERT_TRUE(std::all_of(cells.begin(), cells.end(), [](int n) { return n == 1; }))
              << "pixel " << pixel << " dimension " << dimension << " m " << m << " a " << a;
        }
}

TEST(Sobol, PairsArePaddedIndependently) {
  // The correlation of one pair's first number with another's, over pixels and samples.
  double sum = 0;
  constexpr int kPixels = 4000, kSamples = 16;
  for (std::uint32_t p = 0; p < kPixels; ++p)
    for (std::uint32_t k = 0; k < kSamples; ++k) {
      const auto pixel = sobol::pixel_hash(p, 9);
      sum += (sobol::pair(pixel, k, 0).u - 0.5) * (sobol::pair(pixel, k, 1).u - 0.5);
    }
  // The mean of independent numbers has a standard deviation of 1/12 over the root of their number.
  EXPECT_LT(std::abs(sum / (kPixels * kSamples)), 5.0 / 12 / std::sqrt(kPixels * kSamples));
}

}  // namespace
}  // namespace lobelia
