// Comparing two pictures: numbers, and a verdict with its reasons.
#pragma once

#include "compare/nonfinite.hpp"
#include "compare/uncertainty/error_bars.hpp"

namespace lobelia {

struct MetricLimit {
  std::string metric;  ///< id of an output of the catalogue that takes a limit
  double limit = 0;    ///< the last value that passes, see Better
};

/// The known noise of the pictures, and how to judge by it.
struct NoiseOptions {
  std::optional<PictureNoise> a = {}, b = {};  ///< at least one of them
  /// Chance that pictures of one expectation are called different, by whichever of the limits.
  double significance = 0.01;
  int bootstraps = 32;     ///< pairs of pictures for the error bars, see DrawOptions
  std::uint64_t seed = 0;  ///< of their noise
};

/// The type that the user gives a layer. `layer` is one of the names that is_layer_called() knows.
struct LayerTypeChoice {
  std::string layer;
  LayerType type = LayerType::kColour;
};

struct ComparisonOptions {
  Viewing viewing;
  /// The default limits are judged too, each unless `limits` has one on its metric; with a tolerance without the one on
  /// max_rel_peak.
  std::vector<MetricLimit> limits;
  bool default_limits = true;
  std::vector<MetricLimit> warnings = {};  ///< reported like limits, but no part of the verdict
  std::optional<Tolerance> tolerance = {};
  /// By pixel in reading order, not 0 inside the mask. Differences are also measured inside and outside of it. Empty for
  /// none.
  PixelFlags mask = {};
  std::vector<std::string> mask_of = {};  ///< what the mask was made of, for readers of the record
  /// By pixel, not 0 where the highlight may lie. Empty: anywhere.
  PixelFlags surfaces = {};
  /// The part of pictures from files that is compared; see take_part().
  std::optional<PixelWindow> crop = {};
  /// By pixel of that part, not 0 where all pictures count as equal. Empty for none.
  PixelFlags ignored = {};
  std::vector<std::string> ignored_of = {};
  /// The metrics to measure: names as is_named() takes them, or "default" for all that need not be requested; empty is
  /// "default". What the limits are on is measured as well.
  std::vector<std::string> metrics = {};
  /// Differences are also measured in the highlight, and its default limits are judged.
  bool highlight = false;
  /// The largest rounding error of a stored value as bright as the reference's peak, in radiance: default limits on
  /// shares of the light allow it.
  double rounding = 0;
  /// A NaN or an infinity that both pictures have in the same place is no difference; see compare_pictures().
  bool allow_equal_nonfinite = false;
  std::optional<NoiseOptions> noise = {};  ///< if set, the verdict is same, different or undecided
  std::vector<LayerTypeChoice> layer_types = {};  ///< of layers of files; see compare_pictures()
  /// Input of the metrics for the layer's type; null for a layer of colours.
  const LayerInput* layer = nullptr;
};

/// The options for a user who chooses none: all default limits, and an exposure that suits the pair. Everything that judges
/// pictures begins with them.
ComparisonOptions usual_options();

/// The default limits on the whole picture, and on its highlight.
std::span<const MetricLimit> default_limits();
std::span<const MetricLimit> highlight_limits();

/// "rmse 0.01, psnr 40", with `mark` on both sides of each id.
std::string limits_text(std::span<const MetricLimit> limits, std::string_view mark = "");

/// From the best to the worst; named by records::kVerdicts.
enum class Verdict : std::uint8_t {
  kPass,
  kDiffers,    ///< over a limit, or more outliers than allowed
  kNonFinite,  ///< a NaN or an infinity in one of them: nothing was measured, nothing can pass
  // For pictures with noise:
  kSame,       ///< every limit holds for its whole error bar
  kDifferent,  ///< a limit is broken for its whole error bar, one that holds for all limits together
  kUndecided,  ///< the noise is too strong to decide: no pass
};
constexpr std::string_view verdict_name(Verdict verdict) {
  return records::kVerdicts[std::size_t(verdict)];
}
bool is_pass(Verdict verdict);  ///< pass or same

/// A metric that was requested, or needs no option, and could not be computed.
using NotMeasured = records::NotMeasured;

/// LimitResult::standing, for pictures with noise: for the whole error bar, or open.
struct Standing {
  static constexpr std::string_view kHolds = "holds", kBroken = "broken", kOpen = "open";
};

/// `value` is NaN if it could not be measured. Only a limit that holds passes.
using LimitResult = records::Limit;

/// The distance between two references. No picture can be expected to be nearer. `metrics` compares the second
/// reference with the first; empty if a value is not finite.
using ReferenceFloor = records::ReferenceFloor;

struct Comparison {
  Verdict verdict = Verdict::kDiffers;
  LayerType type = LayerType::kColour;  ///< what was compared
  std::string finding;  ///< of identifiers that differ: which is most often where another should be
  records::Nonfinite nonfinite;
  Viewing viewing;
  records::Named<double> metrics;  ///< in the catalogue's order; empty if a value is not finite
  std::vector<NotMeasured> not_measured;  ///< likewise; only outputs that take a limit
  std::vector<LimitResult> limits;        ///< the verdict follows from these
  std::vector<LimitResult> warnings;
  /// Sentences: limits that contradict each other, see disagreements(). The verdict does not depend on them.
  std::vector<std::string> disagreement;
  std::vector<std::string>
      blind_limits;  ///< sentences: what given limits cannot see, see blind_limits()
  std::vector<records::Fault> faults;  ///< of pictures that do not pass, see find_faults()
  std::optional<Tolerance> tolerance;
  std::optional<std::int64_t> mask_pixels;       ///< inside the mask, if there was one
  std::vector<std::string> mask_of;              ///< what the mask was made of, if that is known
  std::optional<records::Mask> ignored;          ///< pixels that count as equal
  std::optional<PixelWindow> crop;               ///< the part that was compared; if not, everything
  std::optional<std::int64_t> highlight_pixels;  ///< if it was asked for, and all values are finite
  double highlight_share = 0;                    ///< of all pixels, likewise
  /// The reference's highlights and those that only the judged picture has, each judged by itself, the worst first. Empty
  /// if nobody asked for them.
  std::vector<records::LocalHighlight> highlights;
  std::optional<ReferenceFloor> reference_floor;  ///< if there was a second reference
  /// How the noise was taken into account, if it was known and every value is finite.
  std::optional<records::Uncertainty> uncertainty;
  ErrorBars error_bars;  ///< likewise

  /// The value of a metric, or NaN if it was not measured.
  double value(std::string_view id) const;
  /// Why it was not measured, or empty.
  std::string_view why_not_measured(std::string_view id) const;
};

/// Throws Error(kUsage) for options out of range, with the nearest name for an unknown metric.
void check_options(const ComparisonOptions& options);

/// Compares `a` with the reference `b`. Throws Error(kInput) if their sizes differ or are 0, and the errors of
/// check_options().
Comparison compare(const Image& a, const Image& b, const ComparisonOptions& options);

/// The distance of a second reference `c` from `b` under the viewing condition of the options. Throws as compare().
ReferenceFloor measure_reference_floor(const Image& c, const Image& b,
                                       const ComparisonOptions& options);

/// `a`, `b` and the second reference `c`, if there was one, are the record's file names.
records::Comparison comparison_record(const Comparison& comparison, const std::string& a,
                                      const std::string& b, const std::string& c = "");

/// |a - b| per channel / white_at, clipped at 1, not display-encoded. Magenta where a value is not finite. With
/// white_at 0 every difference is white. Throws Error(kInput) if the sizes differ.
DisplayImage difference_picture(const Image& a, const Image& b, double white_at);

}  // namespace lobelia
