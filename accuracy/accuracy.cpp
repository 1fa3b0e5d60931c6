#include "accuracy/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "accuracy/lobe_candidates.hpp"
#include "accuracy/lobe_error.hpp"
#include "accuracy/picture_truth.hpp"
#include "accuracy/pixel_subset.hpp"
#include "compare/display_light.hpp"
#include "compare/metrics/ciede2000.hpp"
#include "compare/metrics/metric.hpp"
#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/image_values.hpp"
#include "renderer/peak_bound.hpp"
#include "renderer/plan/plan.hpp"

namespace lobelia::accuracy {
namespace {

/// What any picture of ours is off by: its values are float32, and so are a diffuse base's.
constexpr double kStorage = 2e-7;
/// Added to what a look at some of the pixels says: errors between them, and the noise of the look itself.
constexpr double kLookMargin = 1.25;
/// Of pixels, in the look; the picture's may be a little more of those that err: by 0.5 % of all.
constexpr double kLookShare = 0.995;
/// Sides of looks without noise and with it.
constexpr int kQuietSide = 128, kNoisySide = 48;
/// Of the truth of a noisy look, by the most that may be chosen: its noise is then a small part of any.
constexpr int kTruthSamples = 8;

bool is_noisy(const Scene& scene) {
  return scene.sampler.sample_count > 1 || scene.depth.glossy > 0 ||
         scene.camera.aperture_radius > 0 ||
         !std::all_of(scene.lights.begin(), scene.lights.end(), is_delta);
}

struct LobeVariant {
  std::optional<LobeId> lobe;  ///< none: every highlight's own
  Precision precision;
  bool is_own;
  double cost;

  Scene of(const Scene& scene) const { return lobe ? with_lobe(scene, *lobe) : scene; }
};

/// The dearest highlight counts.
double cost_of(const Scene& scene, std::optional<LobeId> lobe, Precision precision,
               const CostModel& model) {
  double most = 0;
  for (const Material& material : scene.materials)
    if (has_highlight(material))
      most = std::max(most, model(lobe.value_or(material.highlight.lobe), precision));
  return most;
}

/// From the cheapest; the scene's own lobe before others that cost as much, the wider precision before the
/// narrower.
std::vector<LobeVariant> ways_of(const Scene& scene, const CostModel& model) {
  const auto own = own_lobe(scene);
  std::vector<std::optional<LobeId>> lobes;
  for (const LobeId lobe : lobe_candidates(scene)) lobes.push_back(lobe);
  if (!own) lobes.push_back(std::nullopt);
  std::vector<LobeVariant> ways;
  for (const auto& lobe : lobes)
    for (const Precision p : {Precision::kFloat64, Precision::kMixed, Precision::kFloat32})
      ways.push_back({lobe, p, lobe == own, cost_of(scene, lobe, p, model)});
  std::stable_sort(ways.begin(), ways.end(), [](const LobeVariant& a, const LobeVariant& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.is_own && !b.is_own;
  });
  return ways;
}

/// Upper bounds of the errors of pictures without noise, of their peaks.
class Bounds {
 public:
  Bounds(const Scene& scene, double peak) : scene_(scene), least_half_(min_half_lengths(scene)) {
    Scene highlights = scene;
    for (Material& material : highlights.materials) material.diffuse_reflectance = {};
    scale_ = peak_bound(highlights, highlights.lights) / peak;
  }

  /// All that the lights can bring to highlights, of the picture's peak: by so much an error of highlights
  /// may be larger in the picture.
  double scale() const { return scale_; }

  double of(const LobeVariant& way) const {
    double most = 0;
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      if (!has_highlight(scene_.materials[i])) continue;
      const Highlight& own = scene_.materials[i].highlight;
      const Highlight other = way.lobe ? with_lobe(own, *way.lobe) : own;
      const double ratio = radiance_coefficient(other) / radiance_coefficient(own);
      // A grid's best point, refined, is the largest but for roundings; a hundredth covers those.
      most = std::max(most, 1.01 * highlight_difference(other, own) +
                                ratio * shading_error_bound(way.precision, other, least_half_[i]));
    }
    return scale_ * most + kStorage;
  }

 private:
  const Scene& scene_;
  std::vector<double> least_half_;
  double scale_;
};

/// Of the pixels at display white: what that share of them does not exceed.
double ciede2000_percentile(const Image& picture, const Image& truth, double share) {
  const double stops =
      std::clamp(exposure_for_peak(peak_value(truth)), -kMaxExposureStops, kMaxExposureStops);
  auto differences = ciede2000_of_pixels({picture, stops}, {truth, stops});
  return percentile(differences.values, share);
}

/// Some of the picture's pixels, made by the scene's own lobe in float64.
class Look {
 public:
  Look(const Scene& scene, Measure measure, int most_samples)
      : noisy_(is_noisy(scene)),
        measure_(measure),
        scene_(pixel_subset(scene, noisy_ ? kNoisySide : kQuietSide)) {
    Scene other = scene_;
    ++other.sampler.seed;
    RenderOptions options = noisy_ ? with_samples(kTruthSamples * most_samples) : RenderOptions();
    options.precision = Precision::kFloat64;
    truth_ = render(other, options).image;
  }

  bool is_black() const { return !(peak() > 0); }
  double peak() const { return peak_value(truth_); }
  double error(const LobeVariant& way, int samples) const {
    RenderOptions options = noisy_ ? with_samples(samples) : RenderOptions();
    options.precision = way.precision;
    const Image image = render(way.of(scene_), options).image;
    const double error = measure_ == Measure::kCiede2000P99
                             ? ciede2000_percentile(image, truth_, kLookShare)
                             : rms_of_peak(image, truth_);
    return kLookMargin * error + (measure_ == Measure::kCiede2000P99 ? 0 : kStorage);
  }

 private:
  bool noisy_;
  Measure measure_;
  Scene scene_;
  Image truth_;
};

/// Fills in what a way makes of a choice.
Choice chosen(Choice choice, const Scene& scene, const LobeVariant& way, double predicted) {
  choice.scene = way.of(scene);
  choice.lobe = way.lobe;
  choice.precision = way.precision;
  choice.cost = way.cost;
  choice.predicted = predicted;
  return choice;
}

/// The first of the ways, from the cheapest, whose error is small enough; counts those before it.
template <class Error>
const LobeVariant* first_that_holds(const std::vector<LobeVariant>& ways, const Error& error,
                                    Choice& choice) {
  for (const LobeVariant& way : ways) {
    choice.predicted = error(way);
    if (choice.predicted <= choice.asked.value) return &way;
    ++choice.others;
  }
  return nullptr;
}

const LobeVariant& own_way(const std::vector<LobeVariant>& ways) {
  return *std::find_if(ways.begin(), ways.end(), [](const LobeVariant& way) {
    return way.is_own && way.precision == Precision::kFloat64;
  });
}

/// The choice after a look that saw nothing, and so cannot tell variants apart.
Choice choose_black(Choice choice, const Scene& scene, const std::vector<LobeVariant>& ways) {
  choice.basis = Basis::kLook;
  choice.why =
      "every pixel that was looked at is black, where all ways do alike: the scene's own lobe in float64, with "
      "its own samples";
  return chosen(choice, scene, own_way(ways), kStorage);
}

Choice choose_quiet(Choice choice, const Scene& scene, const std::vector<LobeVariant>& ways) {
  const Look look(scene, choice.measure, 1);
  if (look.is_black()) return choose_black(std::move(choice), scene, ways);
  if (choice.measure == Measure::kCiede2000P99) {
    choice.basis = Basis::kLook;
    const LobeVariant* way = first_that_holds(
        ways, [&](const LobeVariant& w) { return look.error(w, 1); }, choice);
    choice.why = fmt::format(
        "the cheapest of {} ways whose error, in a look at every few pixels and with a quarter added, is "
        "within what was asked; {} cheaper ones are not",
        ways.size(), choice.others);
    return chosen(choice, scene, *way, choice.predicted);
  }
  const Bounds bounds(scene, look.peak());
  const LobeVariant* way = first_that_holds(
      ways, [&](const LobeVariant& w) { return bounds.of(w); }, choice);
  if (way) {
    choice.why = fmt::format(
        "the cheapest of {} ways whose bound is within what was asked; {} cheaper ones are not. The "
        "lights can bring {:.3g} times the picture's peak to highlights, and so much their errors count",
        ways.size(), choice.others, bounds.scale());
    return chosen(choice, scene, *way, choice.predicted);
  }
  // Vectors rounded to float64 do not know their half vector where light and eye face each other.
  choice.basis = Basis::kLook;
  choice.why =
      "no way has a bound as small as what was asked: the scene's own lobe in float64 is the best there is";
  return chosen(choice, scene, own_way(ways), kStorage);
}

Choice choose_noisy(Choice choice, const Scene& scene, const std::vector<LobeVariant>& ways,
                    int most_samples) {
  choice.basis = Basis::kLook;
  const Look look(scene, choice.measure, most_samples);
  if (look.is_black()) return choose_black(std::move(choice), scene, ways);
  const LobeVariant& own = own_way(ways);
  int samples = 1;
  double error = look.error(own, samples), best = error;
  while (error > choice.asked.value && samples < most_samples) {
    samples = std::min(2 * samples, most_samples);
    error = look.error(own, samples);
    best = std::min(best, error);
  }
  if (error > choice.asked.value)
    throw Error(
        ExitCode::kInput,
        fmt::format(
            "--accuracy {}: cannot be reached with {} samples a pixel, where the noise alone "
            "comes to {:.2g}; the best possible is --accuracy {}{:.2g}",
            accuracy_text(choice.asked), most_samples, best,
            choice.asked.unit == Accuracy::Unit::kCiede2000 ? "de2000=" : "",
            std::ceil(best / std::pow(10, std::floor(std::log10(best)) - 1)) *
                std::pow(10, std::floor(std::log10(best)) - 1)));
  choice.samples = samples;
  const LobeVariant* way = first_that_holds(
      ways,
      [&](const LobeVariant& w) { return w.cost > own.cost ? INFINITY : look.error(w, samples); },
      choice);
  choice.why = fmt::format(
      "with {} samples the scene's own lobe is within what was asked, in a look at every few pixels and "
      "with a quarter added; of {} ways this is the cheapest that still is, and {} cheaper ones are not",
      samples, ways.size(), choice.others);
  return chosen(choice, scene, *way, choice.predicted);
}

}  // namespace

void Choice::apply(RenderOptions& options) const {
  options.precision = precision;
  if (!samples) return;
  const RenderOptions counted = with_samples(*samples);
  options.target_error = counted.target_error;
  options.max_samples = counted.max_samples;
}

Choice choose(const Scene& scene, const Accuracy& asked, int most_samples, const CostModel& model) {
  Choice choice;
  choice.asked = asked;
  const bool noisy = is_noisy(scene);
  choice.measure = asked.unit == Accuracy::Unit::kCiede2000 ? Measure::kCiede2000P99
                   : noisy                                  ? Measure::kRmsOfPeak
                                                            : Measure::kMaxOfPeak;
  choice.own_cost = cost_of(scene, std::nullopt, Precision::kFloat64, model);
  const std::vector<LobeVariant> ways = ways_of(scene, model);
  return noisy ? choose_noisy(std::move(choice), scene, ways,
                              std::clamp(most_samples, 1, kMostChosenSamples))
               : choose_quiet(std::move(choice), scene, ways);
}

}  // namespace lobelia::accuracy
