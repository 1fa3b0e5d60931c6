// The time of a whole picture and its error, by lobe and precision.
//
// Each lobe replaces the scene's own, with the coefficient that makes its energy exact. The error is that of the
// picture: of lobe, precision and, with random sampling, noise together.
#include "studies/cost/benchmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pictures/half.hpp"
#include "base/system/error.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "studies/accuracy/accuracy.hpp"
#include "studies/accuracy/lobe_candidates.hpp"

namespace lobelia::cost {
namespace {

struct Combination {
  LobeId lobe;
  Precision precision;
  Scene scene;
  RenderResult first;  ///< not timed
  std::vector<double> seconds;

  RenderResult render() const {
    RenderOptions options;
    options.threads = 1;
    options.precision = precision;
    return lobelia::render(scene, options);
  }
};

/// The film in the same proportions for a given number of rays; fewer would measure fixed costs rather than pixels.
Scene sized(const Scene& scene, const Options& options) {
  const double rays = options.rounds(1 << 14, 1 << 18, 1 << 20);
  const double pixels = std::max(rays / scene.sampler.sample_count, 4096.0);
  const double shape = std::sqrt(double(scene.film.width) / scene.film.height);
  Scene result = scene;
  result.film.width = std::max(1, int(std::lround(std::sqrt(pixels) * shape)));
  result.film.height = std::max(1, int(std::lround(std::sqrt(pixels) / shape)));
  return result;
}

/// How well --accuracy predicts the order of the measured times.
std::string order_remark(const std::vector<Variant>& variants) {
  int clear = 0, reversed = 0;
  double worst = 1;
  for (std::size_t i = 0; i < variants.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const int slower = clearly_slower(variants[i], variants[j]);
      if (slower == 0) continue;
      ++clear;
      const double predicted =
          *variants[j].facts->predicted_cost - *variants[i].facts->predicted_cost;
      if (predicted * slower >= 0) continue;
      ++reversed;
      const double ratio = variants[i].seconds->median / variants[j].seconds->median;
      worst = std::max({worst, ratio, 1 / ratio});
    }
  return fmt::format(
      "of {} pairs of variants of which one is clearly slower, the order of costs that --accuracy goes by has {} "
      "the other way round, by {:.0f} % of the time at most",
      clear, reversed, 100 * (worst - 1));
}

Table table_of(const NamedScene& named, const Options& options) {
  const Scene scene = sized(named.scene, options);
  const bool in_half_floats = std::ranges::all_of(
      scene.materials, [](const Material& m) { return m.highlight.exponent <= kGreatestHalf; });
  std::vector<Combination> cases;
  for (const LobeId& lobe : accuracy::lobe_candidates(scene))
    for (std::size_t p = 0; p < kPrecisionCount; ++p)
      if (Precision(p) != Precision::kFloat16 || in_half_floats)
        cases.push_back({lobe, Precision(p), accuracy::with_lobe(scene, lobe), {}, {}});

  const int rounds = options.rounds(3, 9, 25);
  for (int round = -1; round < rounds; ++round) {
    options.progress(fmt::format("{}, round {} of {}", named.name, std::max(1, round + 1), rounds));
    for (Combination& c : cases) {
      RenderResult result = c.render();
      if (round < 0) {
        c.first = std::move(result);
        continue;
      }
      c.seconds.push_back(result.render_seconds);
      if (!std::ranges::equal(c.first.image.values(), result.image.values()))
        throw Error(ExitCode::kInternal, "{}, {}, {}: two renders of one scene differ", named.name,
                    info(c.lobe).name, name(c.precision));
    }
  }

  options.progress(fmt::format("{}, errors", named.name));
  const accuracy::PictureTruth truth = accuracy::picture_truth(
      scene, std::min(1 << 14, scene.sampler.sample_count * options.rounds(4, 16, 64)));
  Table table;
  table.id = "picture-" + named.name;
  table.level = "picture";
  table.title = fmt::format("{}: {} x {} pixels", named.name, scene.film.width, scene.film.height);
  table.per = "megapixel";
  table.errors = {
      {"de2000_p99", "CIEDE2000 that 99 % of the pixels do not exceed, the peak at white"},
      {"flip", "mean LDR-FLIP, the peak at white"},
      {"max_rel_peak", "largest error of a value, of the peak"}};
  table.remarks = {"truth: " + truth.how};
  const double megapixels = 1e-6 * scene.film.width * scene.film.height;
  for (Combination& c : cases) {
    const auto error = [&](std::string_view metric) {
      return accuracy::measure_at_peak(metric, c.first.image, truth.image);
    };
    const std::string lobe(info(c.lobe).name), precision(name(c.precision));
    Variant& variant = table.variants.emplace_back();
    variant.name = fmt::format("{}, {}{}", lobe, precision,
                               c.precision == Precision::kFloat16 ? " (emulated)" : "");
    variant.settings = {
        {"lobe", lobe}, {"precision", precision}, {"samples", std::to_string(c.first.samples)}};
    variant.seconds = records::rounds_record(per(summary(std::move(c.seconds)), megapixels));
    variant.errors = {{"de2000_p99", error("ciede2000.p99")},
                      {"flip", error("flip.ldr.mean")},
                      {"max_rel_peak", error("max_rel_peak")}};
    records::CostFacts& facts = variant.facts.emplace();
    facts.predicted_cost = accuracy::shading_cost(c.lobe, c.precision);
    facts.rays = rays_record(c.first.work);
  }
  if (scene.sampler.sample_count > 1)
    table.remarks.push_back(
        fmt::format("errors are of lobe, precision and the noise of {} samples together",
                    scene.sampler.sample_count));
  table.remarks.push_back(order_remark(table.variants));
  return table;
}

}  // namespace

std::vector<Table> measure_pictures(const Options& options) {
  std::vector<Table> tables;
  for (const NamedScene& scene : options.scenes) tables.push_back(table_of(scene, options));
  return tables;
}

}  // namespace lobelia::cost
