// What a metric is: results with names, and a function of two pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/display_light.hpp"
#include "core/image.hpp"

namespace lobelia {

struct NoiseOfPair;  // compare/uncertainty/z_test.hpp

/// FLIP's standard viewer: a display 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr double kDefaultPixelsPerDegree = 3840 * std::numbers::pi / 180;
/// Below, FLIP's feature filter is narrower than a pixel; above, its filters only cost time.
inline constexpr double kMinPixelsPerDegree = 5, kMaxPixelsPerDegree = 1000;
inline constexpr double kMaxExposureStops = 100;

/// The exposures that HDR-FLIP looks at, evenly spaced.
struct HdrExposures {
  double start_stops = 0, stop_stops = 0;
  int count = 2;
  bool automatic = false;  ///< chosen from the reference, see automatic_exposures()
  /// Why an automatic range could not be chosen: HDR-FLIP is not measured then. Empty if there is a range.
  std::string problem = {};
};
inline constexpr int kMaxHdrExposures = 100;

/// How the pictures are looked at. One for a whole set of comparisons, and in every record.
struct Viewing {
  double exposure_stops = 0;
  double pixels_per_degree = kDefaultPixelsPerDegree;
  std::optional<HdrExposures> hdr_exposures = {};   ///< without them there is no HDR-FLIP
  std::shared_ptr<const DisplayView> display = {};  ///< null: a plain sRGB display
};

/// At the exposure, and on the display, of `viewing`; finite values only. As DisplayLight: of a plain display it is
/// a view, which the picture must outlive.
inline DisplayLight as_shown(const Image& image, const Viewing& viewing) {
  return DisplayLight::of(image, viewing.exposure_stops, viewing.display.get());
}

/// A pixel is an outlier if |a - b| > relative * |b| + of_peak * peak in any of its channels.
struct Tolerance {
  double relative = 0;  ///< share of the reference's value
  double of_peak = 0;   ///< share of the reference's brightest value
  std::int64_t allowed_outliers = 0;
  /// By pixel, 1 where an outlier may lie (silhouettes, terminators, shadow edges: see edge_ring in
  /// verify/); none may lie elsewhere. Empty: they may lie anywhere.
  std::vector<std::uint8_t> edges = {};
};

/// A pair of pictures of one size without non-finite values; `b` is the reference.
struct MetricInput {
  const Image& a;
  const Image& b;
  DisplayLight shown_a, shown_b;
  double pixels_per_degree;
  const Tolerance* tolerance = nullptr;  ///< null if none was asked for
  const HdrExposures* hdr_exposures = nullptr;
  /// By pixel, not 0 where it is inside; empty if none was given.
  std::span<const std::uint8_t> mask = {};
  const NoiseOfPair* noise = nullptr;  ///< null if neither picture is known to have any
};

/// Which way a number is to go: what a limit on it means, and what equal pictures have.
enum class Better : std::uint8_t {
  kLower,     ///< an error, never negative; equal pictures have 0; a limit is the most that passes
  kNearZero,  ///< a signed error; equal pictures have 0; a limit is the most that its size may be
  kHigher,    ///< a likeness; equal pictures have `best`; a limit is the least that passes
  kNeither,   ///< a fact, a place or a scale, to read an error by: no limit may be set on it
};

/// The kind of values a metric compares. Metrics of one family mostly agree. If two families disagree, that
/// tells the kind of difference (compare/disagreement.hpp).
enum class Family : std::uint8_t {
  kRadiance,    ///< scene-linear values
  kColour,      ///< colours of single pixels, as shown
  kStructure,   ///< correlation within windows, as shown
  kVisibility,  ///< what an eye notices at a viewing distance
};

/// The unit of a metric's values, which decides how they are printed.
enum class Unit : std::uint8_t { kPlain, kRadiance, kShare, kCount };

/// "plain", "radiance", "share", "count"
constexpr std::string_view unit_name(Unit unit) {
  constexpr std::string_view kNames[] = {"plain", "radiance", "share", "count"};
  return kNames[std::size_t(unit)];
}

/// The input that a metric needs. Without it the metric is left out of the results.
enum class Needs : std::uint8_t {
  kNothing,
  kTolerance,
  kMask,  ///< one with a pixel in it
  kHdrExposures,
  kOneWindow,   ///< sides of at least kSsimSide
  kFiveScales,  ///< sides of at least kMsSsimSide
  kNoise,       ///< of one picture at least
};

/// Shortest sides for one window of SSIM, and for a window after the halvings of MS-SSIM.
inline constexpr int kSsimSide = 11, kMsSsimSide = 176;

struct MetricOutput {
  std::string_view id;     ///< "ciede2000.p95": key in the record, name on the command line
  std::string_view title;  ///< "CIEDE2000, 95th percentile"; empty: it is shown by its id
  Unit unit;
  Better better;
  bool symmetric;  ///< does not change when a and b are exchanged
  std::string_view meaning;
  std::string_view explanation = {};  ///< a sentence for those who read the number on a page
  double best = 0;                    ///< the value of equal pictures, unless it is a fact
  bool square = false;  ///< how far it is from the best grows as the square of a difference does
};

struct Metric {
  std::span<const MetricOutput> outputs;
  Family family;
  Needs needs;
  std::string_view source;  ///< where its formula stands, in short: its file has the contract
  /// Fills one value per output, in their order.
  void (*measure)(const MetricInput& input, std::span<double> values);
};

}  // namespace lobelia
