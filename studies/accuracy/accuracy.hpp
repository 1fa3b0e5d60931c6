// A picture by the accuracy that it should have: the cheapest sufficient lobe, precision and number of samples.
//
// The cost of a variant is predicted from its operations, its error from the lobes themselves or from a trial of the
// picture; docs/cost.md says what is promised and how.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/pictures/image.hpp"
#include "base/records/render.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene.hpp"
#include "studies/accuracy/lobe_candidates.hpp"

namespace lobelia::accuracy {

struct Accuracy {
  enum class Unit {
    kOfPeak,     ///< error of a value, of the picture's brightest
    kCiede2000,  ///< that 99 % of the pixels do not exceed, the brightest value at display white
  };
  Unit unit = Unit::kOfPeak;
  double value = 0;  ///< > 0
};
inline constexpr double kMinAccuracyOfPeak = 1e-6, kMaxAccuracyOfPeak = 1;
inline constexpr double kMinAccuracyCiede2000 = 1e-3, kMaxAccuracyCiede2000 = 100;

/// "1e-3", of the peak, or "de2000=1". Throws Error(kUsage) that says what is allowed.
Accuracy parse_accuracy(const std::string& text);
std::string accuracy_text(const Accuracy& accuracy);  ///< as parse_accuracy takes it

/// Why a prediction holds.
enum class Basis {
  kBound,  ///< an upper bound for every pixel, from the lobes and the roundings
  kTrial,  ///< measured on the whole picture; with noise on some of its pixels, with a quarter added
};

/// How an accuracy is measured: by its unit, and in a picture with noise by the root mean square.
enum class Measure { kMaxOfPeak, kRmsOfPeak, kCiede2000P99 };

struct Choice {
  Accuracy asked;
  Measure measure = Measure::kMaxOfPeak;
  Basis basis = Basis::kBound;
  Scene scene;                 ///< with the lobe that was chosen
  std::optional<LobeId> lobe;  ///< none: each highlight's own, which differ
  Precision precision = Precision::kFloat64;
  std::optional<int> samples;     ///< a pixel, where something is random
  double predicted = 0;           ///< the largest expected error
  double cost = 0, own_cost = 0;  ///< shading_cost of it, and of the scene's own lobe in float64
  int others = 0;                 ///< cheaper variants that are not accurate enough
  std::string why;                ///< a sentence

  /// How to render `scene`, on top of what else was asked for.
  void apply(RenderOptions& options) const;
};

/// Orders the variants; a test may have its own.
using CostModel = std::function<double(LobeId, Precision)>;

/// The most samples a pixel that are tried and chosen.
inline constexpr int kMostChosenSamples = 1024;

/// Throws Error(kInput) with the best that is possible if nothing reaches what is asked.
Choice choose(const Scene& scene, const Accuracy& asked, int most_samples = kMostChosenSamples,
              const CostModel& model = shading_cost);

struct Reached {
  double value = 0;
  std::string against;  ///< what truth, in words
  double seconds = 0;   ///< that its making took
  bool black = false;   ///< picture and truth both are: there was nothing to measure
  bool held(const Choice& choice) const { return value <= choice.asked.value; }
};

/// How far the picture that was made by `choice` is from the truth of `scene`, by the choice's measure.
Reached measure_reached(const Scene& scene, const Choice& choice, const Image& picture);

std::string measure_text(Measure measure);  ///< "largest error of the peak"

records::Accuracy accuracy_record(const Choice& choice, const std::optional<Reached>& reached);
/// Lines for people: what was chosen and why; what was reached.
std::string choice_text(const Choice& choice, const records::Accuracy& record);
std::string reached_text(const Choice& choice, const Reached& reached);

// The truth that a picture is compared with: the scene as its file has it, with its own lobe and coefficient.

struct PictureTruth {
  Image image;
  std::string how;  ///< in words
  double seconds = 0;
};

/// By the formulas for each pixel, in double, if they can evaluate the scene; else our own picture in float64 with
/// `samples` of another seed, 1 or more.
PictureTruth picture_truth(const Scene& scene, int samples);

/// With exactly so many random samples. A pixel stays a point or an area, as in the scene.
RenderOptions with_samples(int samples);

/// A metric's value by its id, with the truth's peak at display white.
double measure_at_peak(std::string_view metric, const Image& picture, const Image& truth);

/// Root mean square of the difference over all values, by the truth's peak; 0 for equal pictures.
double rms_of_peak(const Image& picture, const Image& truth);

/// The same scene with a film of every k-th pixel of every k-th row, k odd, about `side` on the longer side. With one ray
/// a pixel, its pixels are the picture's own. Fewer than k rows and columns are left out at the end.
Scene pixel_subset(const Scene& scene, int side);

}  // namespace lobelia::accuracy
