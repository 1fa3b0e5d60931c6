// Several rays a pixel, and where they are spent.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"
#include "renderer/small_highlights.hpp"

namespace lobelia::effects {

struct Antialiasing {
  static constexpr std::string_view kName = "antialiasing", kWork = "rays beyond a pixel's first",
                                    kHides = "";
  /// The first samples, which tell whether a pixel needs the rest: four by four, one in each cell.
  static constexpr int kFirst = 16;
  /// A pixel needs no more if the first samples within its filter's reach are all on one surface and differ by at
  /// most this share of their mean: more samples would then change it by less.
  static constexpr double kSame = 1.0 / 32;
  /// A difference below this share of the brightest possible highlight is invisible.
  static constexpr double kBlack = 1e-5;

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan& plan) {
    const int samples = scene.sampler.sample_count;
    plan.first_samples = samples;
    if (samples == 1) return decide_one_ray(scene, plan);
    std::string reason =
        fmt::format("{} rays a pixel were asked for, {} filter", samples, name(scene.film.filter));
    const std::string everywhere = why_every_pixel(scene, plan);
    const int reach = reach_of(scene.film.filter);
    // A filter that reaches far needs many first samples around the tile.
    const double around = 1 + 2 * (reach - 1) / double(kTileSide);
    if (samples <= kFirst * around * around)
      plan.sample_reason = fmt::format("every pixel: {} are too few to choose pixels by", samples);
    else if (policy == EffectPolicy::kAll)
      plan.sample_reason = "every pixel: all effects were asked for";
    else if (!everywhere.empty())
      plan.sample_reason = "every pixel: " + everywhere;
    else {
      plan.first_samples = kFirst;
      plan.sample_reason = fmt::format(
          "{} everywhere, {} where these differ by over 1/{:g} within {} pixel{}: silhouettes, "
          "highlights, shadows",
          kFirst, samples, 1 / kSame, reach, reach == 1 ? "" : "s");
    }
    return {true, reason + "; " + plan.sample_reason};
  }

 private:
  static EffectDecision decide_one_ray(const Scene& scene, Plan& plan) {
    const std::string one = "one ray a pixel, through its centre";
    if (!scene.sampler.averages_small_highlights) return {false, one};
    const std::vector<SmallHighlight> small = find_small_highlights(scene);
    if (small.empty()) return {false, one};
    plan.averages_highlights = true;
    const double width = std::ranges::min(small, {}, &SmallHighlight::width).width;
    return {
        true,
        fmt::format("{}; {} highlight{} narrower than a pixel, down to a standard deviation of "
                    "{:.2g} pixels: the pixels around are averaged, within {:g} of the energy",
                    one, small.size(), small.size() == 1 ? " is" : "s are", width, kAverageError)};
  }
};

}  // namespace lobelia::effects
