// Several rays a pixel: by each filter without bias, and only where they are needed.
#include <fmt/format.h>

#include "base/system/files.hpp"
#include "base/words/constants.hpp"
#include "lobelia_paths.hpp"
#include "renderer/filters.hpp"
#include "renderer/peak_bound.hpp"
#include "renderer/plan/effects/catalogue.hpp"
#include "renderer/render.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr int kFew[] = {2, 3, 4, 8, 16};

/// The formula of a filter of the catalogue, apart from FilterSampler's tables.
double filter_at(Filter filter, double pixels) {
  static constexpr auto kValues = map_types<double (*)(double)>(
      Filters{}, []<class F>() -> double (*)(double) { return &F::value; });
  return kValues.at(filter.index)(pixels / filter.radius);
}

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

/// Black and white squares of a random size, turned and moved at random: in pixels of the film.
struct Squares {
  static constexpr int kSide = 8;
  double side, turn, x, y;

  explicit Squares(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto between = [&](double a, double b) {
      return std::uniform_real_distribution(a, b)(random);
    };
    side = between(0.8, 2.5);
    turn = between(0, 2 * kPi);
    x = between(-side, side);
    y = between(-side, side);
  }

  /// Seen straight from above, one unit a pixel.
  Scene scene() const {
    Scene scene;
    scene.camera = {{0, 100, 0},
                    {0, 0, 0},
                    {-std::sin(turn), 0, -std::cos(turn)},
                    2 * std::atan(kSide / 200.0) * 180 / kPi};
    scene.film = {kSide, kSide};
    scene.materials = {matt(0), matt(1)};
    scene.planes = {{{x, 0, y}, {0, 1, 0}, 0, 1, side}};
    scene.lights = {DirectionalLight{{0, -1, 0}, {kPi, kPi, kPi}}};
    return scene;
  }

  /// At a point of the film, from its top left.
  double at(double film_x, double film_y) const {
    const double a = film_x - kSide / 2.0, b = film_y - kSide / 2.0;
    const double right = a * std::cos(turn) + b * std::sin(turn);
    const double down = b * std::cos(turn) - a * std::sin(turn);
    const double u = std::floor((right - x) / side), v = std::floor((down - y) / side);
    return std::fmod(std::abs(u + v), 2) == 0 ? 1 : 0;
  }

  /// The integral of picture and filter over that of the filter, by midpoints.
  std::vector<double> filtered(Filter filter) const {
    constexpr int kParts = 240;
    std::vector<double> offset, weight;
    double total = 0;
    for (int i = 0; i < kParts; ++i) {
      offset.push_back(filter.radius * (2 * (i + 0.5) / kParts - 1));
      weight.push_back(filter_at(filter, offset.back()));
      total += weight.back();
    }
    std::vector<double> result;
    for (int py = 0; py < kSide; ++py)
      for (int px = 0; px < kSide; ++px) {
        double sum = 0;
        for (int j = 0; j < kParts; ++j)
          for (int i = 0; i < kParts; ++i)
            sum += weight[i] * weight[j] * at(px + 0.5 + offset[i], py + 0.5 + offset[j]);
        result.push_back(sum / total / total);
      }
    return result;
  }
};

TEST(EveryFilter, IsWithoutBiasAtAnyNumberOfSamples) {
  constexpr int kRenders = 128;
  std::uint64_t picture = 0;
  for (const Filter filter : some_of(all_filters())) {
    const Squares squares(++picture);
    const std::vector<double> expected = squares.filtered(filter);
    Scene scene = squares.scene();
    scene.film.filter = filter;
    for (const int samples : kFew) {
      scene.sampler.sample_count = samples;
      std::vector<double> sum(expected.size()), squared(expected.size());
      for (int k = 0; k < kRenders; ++k) {
        ++scene.sampler.seed;
        const Image image = render(scene, {}).image;
        for (std::size_t i = 0; i < sum.size(); ++i) {
          const double value = image.values()[3 * i];
          sum[i] += value;
          squared[i] += value * value;
        }
      }
      // Each pixel by its own scatter, but by no less than that of independent samples, lest what is rare and was
      // not drawn seem certain; and all together: pixels are independent.
      double chi_square = 0, error = 0, variance = 0;
      for (std::size_t i = 0; i < sum.size(); ++i) {
        const double mean = sum[i] / kRenders;
        const double of_mean = std::max(squared[i] / kRenders - mean * mean,
                                        std::abs(expected[i] * (1 - expected[i])) / samples) /
                               (kRenders - 1);
        const double apart = mean - expected[i];
        // 1e-3: what the quadrature is off by.
        chi_square += apart * apart / (of_mean + 1e-6);
        error += apart;
        variance += of_mean;
      }
      const double z = error / std::sqrt(variance);
      // A sum of squares of k normal numbers has the standard deviation sqrt(2 k).
      const double deviations =
          (chi_square - double(sum.size())) / std::sqrt(2 * double(sum.size()));
      EXPECT_LT(deviations, 5) << label(filter) << ", " << samples << " samples";
      EXPECT_LT(std::abs(z), 4.5) << label(filter) << ", " << samples << " samples";
    }
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

}  // namespace
}  // namespace lobelia
