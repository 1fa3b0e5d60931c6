#include "studies/accuracy/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/error.hpp"
#include "compare/display_light.hpp"
#include "compare/metrics/ciede2000.hpp"
#include "compare/metrics/metric.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/peak_bound.hpp"
#include "renderer/plan/idle_parts.hpp"
#include "renderer/plan/plan.hpp"
#include "renderer/small_highlights.hpp"

namespace lobelia::accuracy {
namespace {

/// The rounding of any picture of ours: its values are float32, and so are a diffuse base's.
constexpr double kStorage = 2e-7;
/// Added to the error of the sampled pixels: for errors between them, and for their own noise.
constexpr double kLookMargin = 1.25;
/// The share of the sampled pixels; the picture itself may have 0.5 % more pixels in error.
constexpr double kLookShare = 0.995;
/// Longer sides of the sampled pixels without noise and with it.
constexpr int kQuietSide = 128, kNoisySide = 48;
/// On a CIEDE2000 without noise: the truth is by formulas, and a value in float32.
constexpr double kCiedeMargin = 1.001;
/// Samples of a noisy truth, in units of the most that may be chosen: its noise is then small beside any choice's.
constexpr int kTruthSamples = 8;

bool is_noisy(const Scene& scene) {
  if (const auto trimmed = without_idle_parts(scene)) return is_noisy(*trimmed);
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

/// The cost of the most expensive highlight.
double cost_of(const Scene& scene, std::optional<LobeId> lobe, Precision precision,
               const CostModel& model) {
  double most = 0;
  for (const Material& material : scene.materials)
    if (has_highlight(material))
      most = std::max(most, model(lobe.value_or(material.highlight.lobe), precision));
  return most;
}

/// From the cheapest; at equal cost the scene's own lobe before others.
std::vector<LobeVariant> variants_of(const Scene& scene, const CostModel& model) {
  const auto own = own_lobe(scene);
  std::vector<std::optional<LobeId>> lobes;
  for (const LobeId& lobe : lobe_candidates(scene)) lobes.push_back(lobe);
  if (!own) lobes.push_back(std::nullopt);
  std::vector<LobeVariant> variants;
  for (const auto& lobe : lobes)
    // Not float16: its emulation is slower than float64, so that it would never be the cheapest.
    for (const Precision p : {Precision::kFloat64, Precision::kMixed, Precision::kFloat32})
      variants.push_back({lobe, p, lobe == own, cost_of(scene, lobe, p, model)});
  std::stable_sort(variants.begin(), variants.end(),
                   [](const LobeVariant& a, const LobeVariant& b) {
                     return a.cost != b.cost ? a.cost < b.cost : a.is_own && !b.is_own;
                   });
  return variants;
}

/// Upper bounds of the errors of pictures without noise, relative to their peaks.
class Bounds {
 public:
  Bounds(const Scene& scene, double peak) : scene_(scene), least_half_(min_half_lengths(scene)) {
    Scene highlights = scene;
    for (Material& material : highlights.materials) material.diffuse_reflectance = {};
    scale_ = peak_bound(highlights, highlights.lights) / peak;
  }

  double of(const LobeVariant& variant) const {
    double most = 0;
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      if (!has_highlight(scene_.materials[i])) continue;
      const Highlight& own = scene_.materials[i].highlight;
      const Highlight other = variant.lobe ? with_lobe(own, *variant.lobe) : own;
      const double ratio = radiance_coefficient(other) / radiance_coefficient(own);
      // The largest difference is found but for roundings; a hundredth covers those.
      most =
          std::max(most, 1.01 * highlight_difference(other, own) +
                             ratio * shading_error_bound(variant.precision, other, least_half_[i]));
    }
    return scale_ * most + kStorage;
  }

 private:
  const Scene& scene_;
  std::vector<double> least_half_;
  /// The most that the lights can bring to highlights, relative to the picture's peak: the factor from an error of a
  /// highlight to one of the picture.
  double scale_;
};

/// The CIEDE2000 that `share` of the pixels do not exceed, with `peak` at display white.
double ciede2000_percentile(const Image& picture, const Image& truth, double peak, double share) {
  const double stops = std::clamp(exposure_for_peak(peak), -kMaxExposureStops, kMaxExposureStops);
  return percentile(ciede2000_of_pixels({picture, stops}, {truth, stops}), share);
}

/// The largest difference, over the pixels that are not edges.
double largest_difference(const Image& a, const Image& b, const PixelFlags& edges = {}) {
  double most = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    if (edges.empty() || !edges[i / 3])
      most = std::max(most, std::abs(double(a.values()[i]) - double(b.values()[i])));
  return most;
}

Image picture_of(const LobeVariant& variant, const Scene& scene) {
  RenderOptions options;
  options.precision = variant.precision;
  return render(variant.of(scene), options).image;
}

/// A picture without noise by the scene's own lobe in float64, and how far others are from it.
class QuietTruth {
 public:
  QuietTruth(const Scene& scene, const LobeVariant& own, Measure measure)
      : scene_(scene),
        measure_(measure),
        picture_(picture_of(own, scene)),
        peak_(peak_value(picture_)) {
    // The average of a highlight over a pixel is another for other pixels.
    if (scene.sampler.averages_small_highlights && !find_small_highlights(scene).empty()) return;
    some_ = pixel_subset(scene, kQuietSide);
    of_some_ = picture_of(own, some_);
  }

  double peak() const { return peak_; }
  double error(const LobeVariant& variant) const {
    return error_of(picture_of(variant, scene_), picture_, kCiedeShare);
  }
  /// At most error(), from few pixels; with CIEDE2000 nearly always.
  double least_error(const LobeVariant& variant) const {
    if (of_some_.values().empty()) return 0;
    return error_of(picture_of(variant, some_), of_some_, kLeastCiedeShare) - 2 * kStorage;
  }

 private:
  static constexpr double kCiedeShare = 0.99, kLeastCiedeShare = 0.98;

  double error_of(const Image& picture, const Image& truth, double share) const {
    return measure_ == Measure::kCiede2000P99
               ? kCiedeMargin * ciede2000_percentile(picture, truth, peak_, share)
               : largest_difference(picture, truth) / peak_ + kStorage;
  }

  const Scene& scene_;
  Measure measure_;
  Image picture_;
  double peak_;
  Scene some_;
  Image of_some_;
};

/// Some of the pixels of a picture with noise, by the scene's own lobe in float64.
class Look {
 public:
  Look(const Scene& scene, Measure measure, int most_samples)
      : measure_(measure), scene_(pixel_subset(scene, kNoisySide)) {
    Scene other = scene_;
    ++other.sampler.seed;
    RenderOptions options = with_samples(kTruthSamples * most_samples);
    options.precision = Precision::kFloat64;
    truth_ = render(other, options).image;
  }

  bool is_black() const { return !(peak_value(truth_) > 0); }
  double error(const LobeVariant& variant, int samples) const {
    RenderOptions options = with_samples(samples);
    options.precision = variant.precision;
    const Image image = render(variant.of(scene_), options).image;
    const double error = measure_ == Measure::kCiede2000P99
                             ? ciede2000_percentile(image, truth_, peak_value(truth_), kLookShare)
                             : rms_of_peak(image, truth_);
    return kLookMargin * error + (measure_ == Measure::kCiede2000P99 ? 0 : kStorage);
  }

 private:
  Measure measure_;
  Scene scene_;
  Image truth_;
};

/// Completes a choice by a variant.
Choice chosen(Choice choice, const Scene& scene, const LobeVariant& variant, double predicted) {
  choice.scene = variant.of(scene);
  choice.lobe = variant.lobe;
  choice.precision = variant.precision;
  choice.cost = variant.cost;
  choice.predicted = predicted;
  return choice;
}

/// The cheapest variant with a small enough error; of several at one price that with the smallest. Counts the cheaper
/// ones. `error` may be infinite for what is not worth a measurement.
template <class Error>
const LobeVariant* cheapest_within(const std::vector<LobeVariant>& variants, const Error& error,
                                   Choice& choice) {
  const LobeVariant* best = nullptr;
  for (const LobeVariant& variant : variants) {
    if (best && variant.cost > best->cost) break;
    const double here = error(variant);
    if (here > choice.asked.value || (best && here >= choice.predicted)) continue;
    best = &variant;
    choice.predicted = here;
  }
  choice.others = int(std::ranges::count_if(
      variants, [&](const LobeVariant& v) { return !best || v.cost < best->cost; }));
  return best;
}

const LobeVariant& own_variant(const std::vector<LobeVariant>& variants) {
  return *std::find_if(variants.begin(), variants.end(), [](const LobeVariant& variant) {
    return variant.is_own && variant.precision == Precision::kFloat64;
  });
}

/// The picture is black, so that the variants cannot be told apart.
Choice choose_black(Choice choice, const Scene& scene, const std::vector<LobeVariant>& variants) {
  choice.basis = Basis::kTrial;
  choice.why =
      "every pixel that was looked at is black, where all ways do alike: the scene's own lobe in float64, with "
      "its own samples";
  return chosen(choice, scene, own_variant(variants), kStorage);
}

Choice choose_quiet(Choice choice, const Scene& scene, const std::vector<LobeVariant>& variants) {
  const LobeVariant& own = own_variant(variants);
  const QuietTruth truth(scene, own, choice.measure);
  if (!(truth.peak() > 0)) return choose_black(std::move(choice), scene, variants);
  const Bounds bounds(scene, truth.peak());
  const bool bounded = choice.measure != Measure::kCiede2000P99;
  const LobeVariant* variant = cheapest_within(
      variants,
      [&](const LobeVariant& v) {
        if (&v == &own) return kStorage;
        const double bound = bounded ? bounds.of(v) : INFINITY;
        if (bound <= choice.asked.value) return bound;
        return truth.least_error(v) > choice.asked.value ? INFINITY : truth.error(v);
      },
      choice);
  const double bound = bounded ? bounds.of(*variant) : INFINITY;
  choice.basis = bound <= choice.asked.value ? Basis::kBound : Basis::kTrial;
  choice.why = fmt::format(
      "the cheapest of {} ways that is within what was asked, {}; {} cheaper ones are not",
      variants.size(),
      choice.basis == Basis::kBound
          ? "by a bound for every pixel"
          : "by a trial of the whole picture against the scene's own lobe in float64",
      choice.others);
  return chosen(choice, scene, *variant, choice.predicted);
}

Choice choose_noisy(Choice choice, const Scene& scene, const std::vector<LobeVariant>& variants,
                    int most_samples) {
  choice.basis = Basis::kTrial;
  const Look look(scene, choice.measure, most_samples);
  if (look.is_black()) return choose_black(std::move(choice), scene, variants);
  const LobeVariant& own = own_variant(variants);
  int samples = 1;
  double error = look.error(own, samples), best = error;
  while (error > choice.asked.value && samples < most_samples) {
    samples = std::min(2 * samples, most_samples);
    error = look.error(own, samples);
    best = std::min(best, error);
  }
  if (error > choice.asked.value)
    throw Error(ExitCode::kInput,
                "--accuracy {}: cannot be reached with {} samples a pixel, where the noise alone "
                "comes to {:.2g}; the best possible is --accuracy {}{:.2g}",
                accuracy_text(choice.asked), most_samples, best,
                choice.asked.unit == Accuracy::Unit::kCiede2000 ? "de2000=" : "",
                std::ceil(best / std::pow(10, std::floor(std::log10(best)) - 1)) *
                    std::pow(10, std::floor(std::log10(best)) - 1));
  choice.samples = samples;
  const LobeVariant* variant = cheapest_within(
      variants,
      [&](const LobeVariant& w) { return w.cost > own.cost ? INFINITY : look.error(w, samples); },
      choice);
  choice.why = fmt::format(
      "with {} samples the scene's own lobe is within what was asked, in a look at every few pixels and "
      "with a quarter added; of {} ways this is the cheapest that still is, and {} cheaper ones are not",
      samples, variants.size(), choice.others);
  return chosen(choice, scene, *variant, choice.predicted);
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
  const std::vector<LobeVariant> variants = variants_of(scene, model);
  return noisy ? choose_noisy(std::move(choice), scene, variants,
                              std::clamp(most_samples, 1, kMostChosenSamples))
               : choose_quiet(std::move(choice), scene, variants);
}

Reached measure_reached(const Scene& scene, const Choice& choice, const Image& picture) {
  // Four times the picture's samples, so that the truth's own noise is the smaller part.
  const PictureTruth truth =
      picture_truth(scene, choice.samples ? std::max(64, 4 * *choice.samples) : 1);
  Reached reached{0, truth.how, truth.seconds};
  reached.black = peak_value(picture) == 0 && peak_value(truth.image) == 0;
  if (reached.black) return reached;
  switch (choice.measure) {
    case Measure::kCiede2000P99:
      reached.value = measure_at_peak("ciede2000.p99", picture, truth.image);
      break;
    case Measure::kRmsOfPeak:
      reached.value = rms_of_peak(picture, truth.image);
      break;
    case Measure::kMaxOfPeak: {
      // On an edge the formulas may hit another surface, which is no error of a lobe or of its precision.
      const bool formulas = truth::why_not_evaluated(scene).empty();
      const auto edges = formulas ? truth::edge_ring(scene) : PixelFlags();
      const double most = largest_difference(picture, truth.image, edges);
      reached.value = most == 0 ? 0 : most / peak_value(truth.image);
      if (formulas) reached.against += ", but for pixels on edges";
    }
  }
  return reached;
}

}  // namespace lobelia::accuracy
