// `--accuracy` beside every way there is: each is rendered, and the cheapest that is near enough may not be cheaper than
// the one chosen.
#include <fmt/format.h>

#include "base/pictures/image_values.hpp"
#include "studies/accuracy/accuracy.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/test.hpp"

namespace lobelia::accuracy {
namespace {

constexpr int kRequests = 170;  ///< three times as many in the long suite
constexpr int kMostSide = 40;

double largest_of_peak(const Image& picture, const Image& truth) {
  double most = 0;
  for (std::size_t i = 0; i < truth.values().size(); ++i)
    most = std::max(most, std::abs(double(picture.values()[i]) - double(truth.values()[i])));
  return most / peak_value(truth);
}

struct Way {
  double cost = 0, error = 0;
};

/// Every way, rendered. `lobe`: none for each highlight's own.
std::vector<Way> all_ways(const Scene& scene, Accuracy::Unit unit, const Image& truth) {
  std::vector<std::optional<LobeId>> lobes{std::nullopt};
  for (const LobeId& lobe : lobe_candidates(scene)) lobes.push_back(lobe);
  std::vector<Way> ways;
  for (const auto& lobe : lobes)
    for (const Precision precision :
         {Precision::kFloat64, Precision::kMixed, Precision::kFloat32}) {
      Way way;
      for (const Material& m : scene.materials)
        if (has_highlight(m))
          way.cost = std::max(way.cost, shading_cost(lobe.value_or(m.highlight.lobe), precision));
      RenderOptions options;
      options.precision = precision;
      const Image image = render(lobe ? with_lobe(scene, *lobe) : scene, options).image;
      way.error = unit == Accuracy::Unit::kCiede2000
                      ? measure_at_peak("ciede2000.p99", image, truth)
                      : largest_of_peak(image, truth);
      ways.push_back(way);
    }
  return ways;
}

std::string fault_of(Scene scene, Random& random) {
  scene.film.width = std::min(scene.film.width, kMostSide);
  scene.film.height = std::min(scene.film.height, kMostSide);
  const std::string text = random.chance(0.3)
                               ? fmt::format("de2000={:.3g}", random.log_between(0.01, 30))
                               : fmt::format("{:.3g}", random.log_between(1e-6, 0.5));
  const Accuracy asked = parse_accuracy(text);
  RenderOptions exact;
  exact.precision = Precision::kFloat64;
  const Image truth = render(scene, exact).image;
  if (!(peak_value(truth) > 0)) return "";
  const Choice choice = choose(scene, asked);
  // The truth by formulas and the storage as float32 may add a little.
  const double enough =
      asked.unit == Accuracy::Unit::kCiede2000 ? asked.value * 0.998 : asked.value * 0.998 - 4e-7;
  for (const Way& way : all_ways(scene, asked.unit, truth))
    if (way.error <= enough && way.cost < choice.cost)
      return fmt::format("{}: chosen for {:g}, and {:g} has {:g}", text, choice.cost, way.cost,
                         way.error);
  RenderOptions options;
  choice.apply(options);
  const Reached reached = measure_reached(scene, choice, render(choice.scene, options).image);
  return reached.held(choice) ? "" : fmt::format("{}: reached {:g}", text, reached.value);
}

TEST(RandomScenes, AreShownNoDearerThanByTheCheapestOfAllWays) {
  expect_of_random_scenes(SceneKind::kExact, kRequests * more_samples(), fault_of);
}

}  // namespace
}  // namespace lobelia::accuracy
