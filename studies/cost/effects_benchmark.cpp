// The price of each effect: a picture with all effects that its scene calls for, and without one of them at a time.
#include "studies/cost/benchmarks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "compare/set/job.hpp"
#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/error_time_chart.hpp"
#include "core/image_values.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "studies/cost/scenes.hpp"

namespace lobelia::cost {
namespace {

struct EffectCase {
  std::string effect;  ///< the one that is left out; may be empty
  Scene scene;
  RenderOptions how;
  RenderResult result;
};

EffectCase make_case(const std::string& effect, const Scene& scene) {
  EffectCase one{effect, scene, {}, {}};
  if (!effect.empty()) {
    Without left = without(effect, scene);
    one.scene = std::move(left.scene);
    one.how.experiment = left.experiment;
  }
  return one;
}

void require_good(const EffectCase& one) {
  if (!is_finite(one.result.image))
    throw Error(ExitCode::kInternal, "effects: a value of our picture is not finite");
  for (const EffectDecision& effect : one.result.plan.effects)
    if (effect.name == one.effect && effect.on)
      throw Error(ExitCode::kInternal, fmt::format("effects: {} is still on", one.effect));
}

/// With `times` the samples and the seed raised by `seed`. One ray a pixel stays one.
Image with_more_samples(const EffectCase& one, int times, int seed) {
  Scene scene = one.scene;
  scene.sampler.seed += std::uint64_t(seed);
  if (scene.sampler.sample_count > 1) scene.sampler.sample_count *= times;
  return render(scene, one.how).image;
}

/// The exposure, in stops, that puts all but a hundredth of the pixels below white. By the peak, a few pixels that see
/// a lamp would make the rest black.
double exposure(const Image& image) {
  std::vector<float> values;
  for (std::size_t i = 0; i < image.values().size(); i += 3)
    values.push_back(*std::max_element(&image.values()[i], &image.values()[i] + 3));
  auto place = values.begin() + std::ptrdiff_t(double(values.size() - 1) * 0.99);
  std::nth_element(values.begin(), place, values.end());
  return exposure_for_peak(*place);
}

std::uint64_t rays(const Work& work) {
  return work.camera_rays + work.shadow_rays + work.mirror_rays + work.scattered_rays;
}

records::Named<records::Work> effects_record(const RenderResult& result) {
  records::Named<records::Work> work;
  for (std::size_t i = 0; i < result.plan.effects.size(); ++i)
    if (const EffectDecision& effect = result.plan.effects[i]; effect.on)
      work.emplace_back(effect.name,
                        records::Work{std::string(effect.work), result.work.of_effect[i]});
  return work;
}

std::string price(const Variant& variant, const Variant& all, const EffectCase& one,
                  const EffectCase& whole) {
  const double with = all.seconds->median, without = variant.seconds->median;
  const double saved = 1 - without / with;
  std::string time =
      saved >= 0 ? fmt::format("{} takes {:.0f} % of the time ({})", one.effect, 100 * saved,
                               short_time_text(with - without))
                 : fmt::format("without {} it takes {:.0f} % longer", one.effect, -100 * saved);
  if (clearly_slower(variant, all) == 0) time += ", which is within the spread";
  const double rays_saved = double(rays(whole.result.work)) - double(rays(one.result.work));
  return fmt::format(
      "{}, {}; without it ({}) the picture is off by {:.2g} dE00 at p99, {:.2g} in the mean", time,
      rays_saved >= 0
          ? fmt::format("{:.2g} of {:.2g} rays", rays_saved, double(rays(whole.result.work)))
          : fmt::format("{:.2g} more rays", -rays_saved),
      in_place_of(one.effect), variant.errors[0].second, variant.errors[1].second);
}

Table measure_scene(const std::string& name, const Scene& scene, const Options& options) {
  std::vector<EffectCase> cases{make_case("", scene)};
  for (const EffectDecision& effect : make_plan(scene, EffectPolicy::kAsCalledFor).effects)
    if (effect.on) cases.push_back(make_case(std::string(effect.name), scene));
  Table table;
  table.id = "effects-" + name;
  table.level = "effects";
  table.title = fmt::format("What the effects of {} cost, {} x {}, {} samples", name,
                            scene.film.width, scene.film.height, scene.sampler.sample_count);
  table.per = "picture";
  table.errors = {{"de2000_p99", "CIEDE2000 from everything, of 99 % of the pixels at most"},
                  {"de2000_mean", "CIEDE2000 from everything, mean"},
                  {"flip_mean", "LDR-FLIP from everything, mean"}};

  const int rounds = options.rounds(3, 5, 11);
  options.progress(fmt::format("{}: {} rounds of {} pictures", name, rounds, cases.size()));
  std::vector<std::function<void()>> work;
  for (EffectCase& one : cases) work.push_back([&one] { one.result = render(one.scene, one.how); });
  const std::vector<Times> times = interleaved(work, rounds);
  for (const EffectCase& one : cases) require_good(one);

  // The loss is measured on pictures with less noise than the timed ones. All have the same seed, so that pixels that
  // the effect does not touch stay the same.
  const int more = options.rounds(16, 4, 4);
  options.progress(name + ": what is lost");
  const Image whole = with_more_samples(cases[0], more, 0);
  CompareChoice choice = plain_choice(exposure(whole));
  choice.metrics = "ciede2000,flip.ldr";
  const ComparisonOptions seen = judging_options(choice);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const EffectCase& one = cases[i];
    const Comparison comparison = compare(with_more_samples(one, more, 0), whole, seen);
    Variant variant;
    variant.name = one.effect.empty() ? "everything" : "without " + one.effect;
    variant.settings = {{"without", one.effect}};
    variant.seconds = records::rounds_record(times[i]);
    variant.errors = {{"de2000_p99", comparison.value("ciede2000.p99")},
                      {"de2000_mean", comparison.value("ciede2000.mean")},
                      {"flip_mean", comparison.value("flip.ldr.mean")}};
    records::CostFacts& facts = variant.facts.emplace();
    facts.rays = rays_record(one.result.work);
    facts.rays_saved = double(rays(cases[0].result.work)) - double(rays(one.result.work));
    facts.seconds_saved = times[0].median - times[i].median;
    facts.work = effects_record(one.result);
    table.variants.push_back(std::move(variant));
    if (!one.effect.empty())
      table.remarks.push_back(price(table.variants.back(), table.variants[0], one, cases[0]));
  }
  const Comparison noise = compare(with_more_samples(cases[0], more, 1), whole, seen);
  table.remarks.push_back(fmt::format(
      "errors are to the picture with everything, both with {} samples of the same seed and brightened by "
      "{:.2f} stops; with another seed everything itself is off by {:.2g} dE00 at p99, {:.2g} in the mean: "
      "noise",
      more * scene.sampler.sample_count, seen.viewing.exposure_stops, noise.value("ciede2000.p99"),
      noise.value("ciede2000.mean")));
  return table;
}

}  // namespace

std::vector<Table> measure_effects(const Options& options) {
  const int side = options.rounds(48, 96, 256);
  std::vector<NamedScene> scenes = options.scenes;
  if (scenes.empty()) scenes.push_back({"everything", everything()});
  std::vector<Table> tables;
  for (NamedScene& named : scenes) {
    Scene scene = with_film(named.scene, side);
    scene.sampler.sample_count = std::min(scene.sampler.sample_count, options.rounds(16, 64, 1024));
    tables.push_back(measure_scene(named.name, scene, options));
  }
  return tables;
}

}  // namespace lobelia::cost
