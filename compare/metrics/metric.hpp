// A metric: named results, and a function of two pictures.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/pictures/pixel_flags.hpp"
#include "compare/display_light.hpp"
#include "compare/highlights/judge.hpp"
#include "compare/layer_type.hpp"

namespace lobelia {

struct NoiseOfPair;  // compare/uncertainty/z_test.hpp
class SharedWork;    // compare/metrics/shared_work.hpp

/// One value a pixel, in reading order. float32 halves the memory (256 MB for 8192 x 8192 pixels).
using PixelValues = std::vector<float, ZeroedMemory<float>>;

/// FLIP's standard viewer: a display 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr double kDefaultPixelsPerDegree = 3840 * std::numbers::pi / 180;
/// With less, FLIP's feature filter is narrower than a pixel; more only costs time.
inline constexpr double kMinPixelsPerDegree = 5, kMaxPixelsPerDegree = 1000;
inline constexpr double kMaxExposureStops = 100;

/// The exposures of HDR-FLIP, evenly spaced.
struct HdrExposures {
  double start_stops = 0, stop_stops = 0;
  int count = 2;
  bool automatic = false;  ///< chosen from the reference, see automatic_exposures()
  /// Why an automatic range could not be chosen, so that HDR-FLIP is not measured. Empty if there is a range.
  std::string problem = {};
  ToneCurve curve = ToneCurve::kAces;
  /// In an automatic range, the parts that the user gave.
  bool given_start = false, given_stop = false, given_count = false;
};
inline constexpr int kMaxHdrExposures = 100;

/// The number of exposures from start to stop that the tool chooses: as many as stops, rounded up, at least 2.
int count_of_exposures(double start_stops, double stop_stops);

/// The range of Andersson et al. 2021, section 3, as in NVIDIA's tool 1.6: from the exposure at which the
/// tone curve maps the reference's largest luminance to 0.85, to that for its median luminance. If that is 0, as of a
/// small highlight on black, the median of the pixels above 0. What `asked` gives stays.
/// Each reference has its own range; only figures of equal ranges are comparable. Throws Error(kInput) if no pixel is
/// above 0, the range has over kMaxHdrExposures, or begins above its end.
HdrExposures automatic_exposures(const Image& reference, const HdrExposures& asked = {});

/// The viewing condition, in every record.
struct Viewing {
  double exposure_stops = 0;
  double pixels_per_degree = kDefaultPixelsPerDegree;
  std::optional<HdrExposures> hdr_exposures = {};   ///< without them HDR-FLIP is not measured
  std::shared_ptr<const DisplayView> display = {};  ///< null: a plain sRGB display
  bool automatic = false;  ///< choose the exposure of each pair, see with_exposures()
  /// A second exposure of the perceptual metrics but HDR-FLIP: the worse of two figures counts.
  std::optional<double> tail_stops = {};
  /// More of them, each for the highlights that are dark at all before, see with_exposures().
  std::vector<double> further_stops = {};
};

/// The picture at the exposure and on the display of `viewing`; finite values only. On a plain display it is a view,
/// which the picture must outlive.
inline DisplayLight as_shown(const Image& image, const Viewing& viewing) {
  return DisplayLight::of(image, viewing.exposure_stops, viewing.display.get());
}

/// Both pictures as a display shows them.
struct ShownPair {
  DisplayLight a, b;
};

/// Both at each exposure after the first.
inline std::vector<ShownPair> further_as_shown(const Image& a, const Image& b,
                                               const Viewing& viewing) {
  std::vector<ShownPair> shown;
  const auto add = [&](double stops) {
    shown.push_back({DisplayLight::of(a, stops, viewing.display.get()),
                     DisplayLight::of(b, stops, viewing.display.get())});
  };
  if (viewing.tail_stops) add(*viewing.tail_stops);
  for (const double stops : viewing.further_stops) add(stops);
  return shown;
}

/// A pixel is an outlier if |a - b| > relative * |b| + of_peak * peak in any of its channels.
struct Tolerance {
  double relative = 0;  ///< share of the reference's value
  double of_peak = 0;   ///< share of the reference's brightest value
  std::int64_t allowed_outliers = 0;
  /// By pixel, 1 where an outlier may lie (silhouettes, terminators, shadow edges: see truth::edge_ring()); none may
  /// lie elsewhere. Empty: anywhere.
  PixelFlags edges = {};
};

/// The pixels that a figure is of.
enum class Region : std::uint8_t {
  kWhole,
  kHighlight,  ///< the bright pixels of either picture (compare/highlight_region.hpp), grown by the metric's footprint
  kMask,       ///< inside the comparison's mask
  kOutside,    ///< outside of it
};
/// "", "highlight", "mask", "outside": part of a figure's id
constexpr std::string_view region_name(Region region) {
  constexpr std::string_view kNames[] = {"", "highlight", "mask", "outside"};
  return kNames[std::size_t(region)];
}

/// Facts by pixel about a pair of layers that are not colours; see compare/layer_types.hpp.
struct LayerInput {
  LayerType type = LayerType::kColour;
  /// For depth: 0 where both have a surface, 1 where neither has, 2 where only one has. Values without a surface are 0.
  PixelFlags background = {};
  /// For identifiers: not 0 where they differ. The pictures of MetricInput are black.
  PixelFlags differs = {};
  /// For a Cryptomatte: the largest difference between the shares of the pixel that one object covers; else empty.
  PixelValues coverage = {};
};

/// A pair of pictures of one size without non-finite values; `b` is the reference.
struct MetricInput {
  const Image& a;
  const Image& b;
  DisplayLight shown_a, shown_b;
  double pixels_per_degree;
  const Tolerance* tolerance = nullptr;  ///< null if none was asked for
  const HdrExposures* hdr_exposures = nullptr;
  /// By pixel, not 0 inside the mask; empty if none was given.
  std::span<const std::uint8_t> mask = {};
  const NoiseOfPair* noise = nullptr;  ///< null if neither picture is known to have noise
  /// By pixel, not 0 in the highlight, before it is grown; empty if it was not asked for.
  std::span<const std::uint8_t> highlight = {};
  /// Those of the reference, each judged by itself, and those that only a has, the worst first; empty if they were not
  /// asked for.
  std::span<const JudgedHighlight> highlights = {};
  std::vector<ShownPair> shown_further = {};  ///< at each exposure after the first
  bool equal = false;                         ///< every value of a is b's
  const LayerInput* layer = nullptr;          ///< null for colours
  /// By pixel, not 0 where the metric is measured; empty: everywhere. Set by measure_metrics().
  std::span<const std::uint8_t> region = {};
  double threshold = 0;  ///< the metric's own. Set by measure_metrics().
  /// The regions of all metrics of the same work, empty that of the whole picture. Set by measure_metrics().
  std::span<const std::span<const std::uint8_t>> regions = {};
  SharedWork* shared = nullptr;  ///< null: nothing is shared. Set by measure_metrics().

  /// By pixel, not 0 where a metric of the same work looks; empty: everywhere.
  std::span<const std::uint8_t> needed() const {
    return regions.size() <= 1 ? region : std::span<const std::uint8_t>();
  }
  bool in_region(std::size_t pixel) const { return region.empty() || region[pixel] != 0; }
};

/// The direction in which a value improves. It decides the meaning of a limit, and the value of equal pictures.
enum class Better : std::uint8_t {
  kLower,     ///< an error, never negative; equal pictures have 0; a limit is the most that passes
  kNearZero,  ///< a signed error; equal pictures have 0; a limit is the largest size that passes
  kHigher,    ///< a similarity; equal pictures have `best`; a limit is the least that passes
  kNeither,   ///< a fact, a place or a scale that helps to read an error; takes no limit
};

/// The kind of values that a metric compares. Metrics of one family mostly agree. A disagreement between families
/// tells the kind of difference (compare/disagreement.hpp).
enum class Family : std::uint8_t {
  kRadiance,    ///< scene-linear values
  kColour,      ///< colours of single pixels, as shown
  kStructure,   ///< correlation within windows, as shown
  kVisibility,  ///< what an eye notices at a viewing distance
};

/// "radiance", "colour", "structure", "visibility"
constexpr std::string_view family_name(Family family) {
  constexpr std::string_view kNames[] = {"radiance", "colour", "structure", "visibility"};
  return kNames[std::size_t(family)];
}

/// The unit of a metric's values decides how they are printed.
enum class Unit : std::uint8_t { kPlain, kRadiance, kShare, kCount };

/// "plain", "radiance", "share", "count"
constexpr std::string_view unit_name(Unit unit) {
  constexpr std::string_view kNames[] = {"plain", "radiance", "share", "count"};
  return kNames[std::size_t(unit)];
}

/// The input that a metric needs. Without it the metric is not measured.
enum class Needs : std::uint8_t {
  kNothing,
  kTolerance,
  kHighlight,
  kHighlights,  ///< MetricInput::highlights
  kHdrExposures,
  kOneWindow,   ///< sides of at least kSsimSide
  kFiveScales,  ///< sides of at least kMsSsimSide
  kNoise,       ///< of at least one picture
  kCoverage,    ///< LayerInput::coverage
};

/// The side of a window of SSIM, and the least side that still holds one after MS-SSIM's halvings.
inline constexpr int kSsimSide = 11, kMsSsimSide = 176;

/// The values that an output which takes a limit can have, whatever the pictures.
struct ValueRange {
  double least = 0, most = std::numeric_limits<double>::infinity();
};
inline constexpr ValueRange kSignedRange{-std::numeric_limits<double>::infinity()};
inline constexpr ValueRange kRatioRange{-1};  ///< of a / b - 1
inline constexpr ValueRange kUnitRange{0, 1};

struct MetricOutput {
  std::string_view id;     ///< "ciede2000.p95": key in the record, name on the command line
  std::string_view title;  ///< "CIEDE2000, 95th percentile"; empty: the id is shown
  Unit unit;
  Better better;
  bool symmetric;  ///< swapping a and b does not change it
  std::string_view meaning;
  std::string_view explanation = {};  ///< a sentence for readers of a page
  double best = 0;                    ///< the value of equal pictures, unless it is a fact
  bool square = false;  ///< its distance from the best grows as the square of a difference
  ValueRange range = {};
  /// In proportion to the largest |a - b| of single values: its noise is that of one value.
  bool is_largest_difference = false;
};

struct Metric {
  std::span<const MetricOutput> outputs;
  Family family;
  Needs needs;
  std::string_view source;  ///< a short citation of the formula; the metric's file is the contract
  /// Fills one value per output, in their order, over the pixels of input.region.
  void (*measure)(const MetricInput& input, std::span<double> values);
  /// Metrics of one work are measured one after the other and share what they make of the pictures (shared_work.hpp).
  /// Empty: this one shares nothing.
  std::string_view work = {};
  /// Measured in regions as well, under ids with the region's name.
  bool in_regions = true;
  /// A difference in one pixel moves the figure of pixels up to so far away; null for 0.
  int (*footprint)(const MetricInput& input) = nullptr;
  Region region = Region::kWhole;
  bool on_request = false;  ///< measured only if a limit or ComparisonOptions::metrics names it
  double threshold = 0;     ///< of a metric that counts pixels: MetricInput::threshold
  /// The only type of layers that it is measured of; it has no region of the highlight.
  std::optional<LayerType> layer = {};
};

}  // namespace lobelia
