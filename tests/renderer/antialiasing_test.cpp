// Several rays a pixel: an even sky stays even by every filter, and rays are spent only where they are needed.
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

}  // namespace
}  // namespace lobelia
