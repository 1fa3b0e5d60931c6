#include "cost/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compare/display_light.hpp"
#include "compare/metrics/ciede2000.hpp"
#include "compare/metrics/metric.hpp"
#include "compare/metrics/peak.hpp"
#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "cost/lobe_candidates.hpp"
#include "cost/lobe_error.hpp"
#include "cost/picture_truth.hpp"
#include "cost/pixel_subset.hpp"
#include "renderer/peak_bound.hpp"
#include "renderer/plan/plan.hpp"
#include "verify/truth/evaluation.hpp"

namespace lobelia::cost {
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

struct Way {
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
std::vector<Way> ways_of(const Scene& scene, const CostModel& model) {
  const auto own = own_lobe(scene);
  std::vector<std::optional<LobeId>> lobes;
  for (const LobeId lobe : lobe_candidates(scene)) lobes.push_back(lobe);
  if (!own) lobes.push_back(std::nullopt);
  std::vector<Way> ways;
  for (const auto& lobe : lobes)
    for (const Precision p : {Precision::kFloat64, Precision::kMixed, Precision::kFloat32})
      ways.push_back({lobe, p, lobe == own, cost_of(scene, lobe, p, model)});
  std::stable_sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) {
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

  double of(const Way& way) const {
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
    if (!(peak() > 0))
      throw Error(
          ExitCode::kInput,
          fmt::format("--accuracy: {} x {} of the picture's pixels are black: there is nothing "
                      "to be accurate about",
                      truth_.width(), truth_.height()));
  }

  double peak() const { return peak_value(truth_); }
  double error(const Way& way, int samples) const {
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

/// Over the pixels that are not edges.
double max_of_peak(const Image& picture, const Image& truth,
                   const std::vector<std::uint8_t>& edges) {
  const auto a = picture.values(), b = truth.values();
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (edges.empty() || !edges[i / 3])
      most = std::max(most, std::abs(double(a[i]) - double(b[i])));
  return most == 0 ? 0 : most / peak_value(truth);
}

std::string asked_text(const Accuracy& asked) {
  return asked.unit == Accuracy::Unit::kCiede2000 ? fmt::format("de2000={:g}", asked.value)
                                                  : fmt::format("{:g}", asked.value);
}

std::string lobe_text(const std::optional<LobeId>& lobe) {
  return lobe ? std::string(info(*lobe).name) : "each highlight's own lobe";
}

/// Fills in what a way makes of a choice.
Choice chosen(Choice choice, const Scene& scene, const Way& way, double predicted) {
  choice.scene = way.of(scene);
  choice.lobe = way.lobe;
  choice.precision = way.precision;
  choice.cost = way.cost;
  choice.predicted = predicted;
  return choice;
}

/// The first of the ways, from the cheapest, whose error is small enough; counts those before it.
template <class Error>
const Way* first_that_holds(const std::vector<Way>& ways, const Error& error, Choice& choice) {
  for (const Way& way : ways) {
    choice.predicted = error(way);
    if (choice.predicted <= choice.asked.value) return &way;
    ++choice.others;
  }
  return nullptr;
}

const Way& own_way(const std::vector<Way>& ways) {
  return *std::find_if(ways.begin(), ways.end(), [](const Way& way) {
    return way.is_own && way.precision == Precision::kFloat64;
  });
}

Choice choose_quiet(Choice choice, const Scene& scene, const std::vector<Way>& ways) {
  const Look look(scene, choice.measure, 1);
  if (choice.measure == Measure::kCiede2000P99) {
    choice.basis = Basis::kLook;
    const Way* way = first_that_holds(
        ways, [&](const Way& w) { return look.error(w, 1); }, choice);
    choice.why = fmt::format(
        "the cheapest of {} ways whose error, in a look at every few pixels and with a quarter added, is "
        "within what was asked; {} cheaper ones are not",
        ways.size(), choice.others);
    return chosen(choice, scene, *way, choice.predicted);
  }
  const Bounds bounds(scene, look.peak());
  const Way* way = first_that_holds(
      ways, [&](const Way& w) { return bounds.of(w); }, choice);
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

Choice choose_noisy(Choice choice, const Scene& scene, const std::vector<Way>& ways,
                    int most_samples) {
  choice.basis = Basis::kLook;
  const Look look(scene, choice.measure, most_samples);
  const Way& own = own_way(ways);
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
            asked_text(choice.asked), most_samples, best,
            choice.asked.unit == Accuracy::Unit::kCiede2000 ? "de2000=" : "",
            std::ceil(best / std::pow(10, std::floor(std::log10(best)) - 1)) *
                std::pow(10, std::floor(std::log10(best)) - 1)));
  choice.samples = samples;
  const Way* way = first_that_holds(
      ways, [&](const Way& w) { return w.cost > own.cost ? INFINITY : look.error(w, samples); },
      choice);
  choice.why = fmt::format(
      "with {} samples the scene's own lobe is within what was asked, in a look at every few pixels and "
      "with a quarter added; of {} ways this is the cheapest that still is, and {} cheaper ones are not",
      samples, ways.size(), choice.others);
  return chosen(choice, scene, *way, choice.predicted);
}

}  // namespace

Accuracy parse_accuracy(const std::string& text) {
  constexpr std::string_view kCiede = "de2000=";
  Accuracy accuracy;
  std::string_view number = text;
  double least = kMinAccuracyOfPeak, most = kMaxAccuracyOfPeak;
  if (number.starts_with(kCiede)) {
    accuracy.unit = Accuracy::Unit::kCiede2000;
    number.remove_prefix(kCiede.size());
    least = kMinAccuracyCiede2000, most = kMaxAccuracyCiede2000;
  }
  if (!parse_number(number, accuracy.value) || !(accuracy.value >= least) ||
      !(accuracy.value <= most))
    throw Error(ExitCode::kUsage,
                fmt::format("--accuracy '{}': allowed is a share of the peak, {:g} to {:g}, or "
                            "de2000=X, X being {:g} to {:g}",
                            printable(text), kMinAccuracyOfPeak, kMaxAccuracyOfPeak,
                            kMinAccuracyCiede2000, kMaxAccuracyCiede2000));
  return accuracy;
}

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
  const std::vector<Way> ways = ways_of(scene, model);
  return noisy ? choose_noisy(std::move(choice), scene, ways,
                              std::clamp(most_samples, 1, kMostChosenSamples))
               : choose_quiet(std::move(choice), scene, ways);
}

Reached measure_reached(const Scene& scene, const Choice& choice, const Image& picture) {
  // Four times the samples of what is judged: the truth's own noise is then the smaller part of what is seen.
  const PictureTruth truth =
      picture_truth(scene, choice.samples ? std::max(64, 4 * *choice.samples) : 1);
  Reached reached{0, truth.how, truth.seconds};
  switch (choice.measure) {
    case Measure::kCiede2000P99:
      reached.value = measure_at_peak("ciede2000.p99", picture, truth.image);
      break;
    case Measure::kRmsOfPeak:
      reached.value = rms_of_peak(picture, truth.image);
      break;
    case Measure::kMaxOfPeak: {
      // On an edge the formulas may see another surface: that is no error of a lobe or of its precision.
      const bool formulas = truth::why_not_evaluated(scene).empty();
      const auto edges = formulas ? truth::edge_ring(scene) : std::vector<std::uint8_t>();
      reached.value = max_of_peak(picture, truth.image, edges);
      if (formulas) reached.against += ", but for pixels on edges";
    }
  }
  return reached;
}

std::string measure_text(Measure measure) {
  switch (measure) {
    case Measure::kCiede2000P99:
      return "CIEDE2000 that 99 % of the pixels do not exceed";
    case Measure::kRmsOfPeak:
      return "root mean square of the errors, of the peak";
    case Measure::kMaxOfPeak:
      break;
  }
  return "largest error, of the peak";
}

Json accuracy_record(const Choice& choice, const std::optional<Reached>& reached) {
  Json record{{"asked", choice.asked.value},
              {"unit", choice.asked.unit == Accuracy::Unit::kCiede2000 ? "de2000" : "ofPeak"},
              {"measure", measure_text(choice.measure)},
              {"chose",
               {{"lobe", choice.lobe ? Json(info(*choice.lobe).name) : Json()},
                {"precision", name(choice.precision)},
                {"samples", choice.samples.value_or(1)}}},
              {"why", choice.why},
              {"operations", {{"chosen", choice.cost}, {"ownInFloat64", choice.own_cost}}},
              {"basis", choice.basis == Basis::kBound ? "bound" : "look"},
              {"predicted", choice.predicted}};
  if (reached)
    record["reached"] = {{"value", reached->value},
                         {"held", reached->held(choice)},
                         {"against", reached->against},
                         {"seconds", reached->seconds}};
  return record;
}

std::string choice_text(const Choice& choice) {
  return fmt::format(
      "accuracy {}: {}, {}{}; {} predicted to be at most {:.2g}. {:g} operations a point, weighted, where the "
      "scene's own lobe in float64 takes {:g}.\n  {}.\n",
      asked_text(choice.asked), lobe_text(choice.lobe), name(choice.precision),
      choice.samples ? fmt::format(", {} samples a pixel", *choice.samples) : std::string(),
      measure_text(choice.measure), choice.predicted, choice.cost, choice.own_cost, choice.why);
}

std::string reached_text(const Choice& choice, const Reached& reached) {
  return fmt::format("reached {:.3g}, {} asked, {}; against {} ({:.2f} s)\n", reached.value,
                     asked_text(choice.asked),
                     reached.held(choice) ? "so it holds" : "so it does NOT hold", reached.against,
                     reached.seconds);
}

}  // namespace lobelia::cost
