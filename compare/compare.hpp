// Comparing two pictures: numbers, and a verdict with its reasons.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/metrics/metric.hpp"
#include "compare/nonfinite.hpp"
#include "compare/uncertainty/error_bars.hpp"
#include "compare/uncertainty/noise.hpp"
#include "core/image.hpp"
#include "records/comparison.hpp"

namespace lobelia {

struct MetricLimit {
  std::string metric;  ///< id of an output of the catalogue that is no fact
  double limit = 0;    ///< the last value that passes, see Better
};

/// The known noise of the pictures, and how to judge by it.
struct NoiseOptions {
  std::optional<PictureNoise> a = {}, b = {};  ///< one of them at least
  double significance =
      0.01;                ///< chance of finding a difference beyond the noise where there is none
  int bootstraps = 16;     ///< pairs that error bars are made of, see error_bars()
  std::uint64_t seed = 0;  ///< of their noise
};

struct ComparisonOptions {
  Viewing viewing;
  std::vector<MetricLimit> limits;
  std::vector<MetricLimit> warnings = {};  ///< reported as limits are, but no part of the verdict
  std::optional<Tolerance> tolerance = {};
  /// By pixel in reading order, not 0 where it is inside: errors are measured there as well, under
  /// ids that end in .mask. Empty for none.
  std::vector<std::uint8_t> mask = {};
  /// A NaN or an infinity that both pictures have in the same place is no difference; see compare_pictures().
  bool allow_equal_nonfinite = false;
  std::optional<NoiseOptions> noise =
      {};  ///< the verdict is then as compare/uncertainty/judgement.hpp has it
};

/// The limits where neither limits nor a tolerance were asked for.
std::span<const MetricLimit> default_limits();

/// From the best to the worst; named by records::kVerdicts.
enum class Verdict : std::uint8_t {
  kPass,
  kDiffers,    ///< over a limit, or more outliers than allowed
  kNonFinite,  ///< a NaN or an infinity in one of them: nothing was measured, nothing can pass
  // Of pictures with noise:
  kSame,       ///< every limit holds, wherever in their error bars the figures are
  kDifferent,  ///< one is broken, wherever in its error bar the figure is
  kUndecided,  ///< it is up to the noise: no pass
};
constexpr std::string_view verdict_name(Verdict verdict) {
  return records::kVerdicts[std::size_t(verdict)];
}
bool is_pass(Verdict verdict);  ///< pass or same

/// A metric that was asked for, or needs no asking, and could not be computed.
using NotMeasured = records::NotMeasured;

struct MetricValue {
  std::string_view id, meaning;
  double value = 0;
};

enum class Standing : std::uint8_t { kHolds, kBroken, kOpen };
constexpr std::string_view standing_name(Standing standing) {
  return records::kStandings[std::size_t(standing)];
}

struct LimitResult {
  std::string metric;
  double limit = 0;
  double value = 0;  ///< NaN where it could not be measured
  bool pass = false;
  /// Set for pictures with noise; only a limit that holds passes.
  std::optional<Standing> standing = {};
  double more_samples = 0;  ///< how many times the samples would decide what is open, about
};

/// How far two references are from each other: what no picture can be asked to be nearer than.
struct ReferenceFloor {
  std::int64_t nonfinite = 0;        ///< pixels of the second reference
  std::vector<MetricValue> metrics;  ///< of it against the first; empty if something is not finite
};

struct Comparison {
  Verdict verdict = Verdict::kDiffers;
  std::int64_t nonfinite_a = 0, nonfinite_b = 0;  ///< pixels with a NaN or an infinity
  std::optional<NonfinitePlace> first_nonfinite_a = {}, first_nonfinite_b = {};
  /// Pixels where both had the same and that was allowed; they are not in the two counts.
  std::optional<std::int64_t> equal_nonfinite = {};
  Viewing viewing;
  std::vector<MetricValue> metrics;  ///< in the catalogue's order; empty if something is not finite
  std::vector<NotMeasured> not_measured;  ///< likewise; those that may have a limit
  std::vector<LimitResult> limits;        ///< that the verdict was made of
  std::vector<LimitResult> warnings;
  /// Sentences: which limits say opposite things, see disagreements(). The verdict does not depend on it.
  std::vector<std::string> disagreement;
  std::optional<Tolerance> tolerance;
  std::optional<std::int64_t> mask_pixels;        ///< inside the mask, if there was one
  std::optional<ReferenceFloor> reference_floor;  ///< if there was a second reference
  /// How the noise was taken into account, where it was known and everything is finite.
  std::optional<records::Uncertainty> uncertainty;
  ErrorBars error_bars;  ///< likewise

  /// The value of a metric, or NaN if it was not measured.
  double value(std::string_view id) const;
  /// Why it was not measured, or empty.
  std::string_view why_not_measured(std::string_view id) const;
};

/// Throws Error(kUsage) for options out of range, with the nearest name for an unknown metric.
void check_options(const ComparisonOptions& options);

/// Compares `a` with the reference `b`. Throws Error(kInput) if their sizes differ or are 0, and as
/// check_options.
Comparison compare(const Image& a, const Image& b, const ComparisonOptions& options);

/// The distance of a second reference `c` from `b`, seen as the options say. Throws as compare.
ReferenceFloor measure_reference_floor(const Image& c, const Image& b,
                                       const ComparisonOptions& options);

/// `a`, `b` and the second reference `c`, if there was one, are the file names
/// that stand in it.
records::Comparison comparison_record(const Comparison& comparison, const std::string& a,
                                      const std::string& b, const std::string& c = "");

/// |a - b| per channel / white_at, clipped at 1, not display-encoded. Magenta where it is not
/// finite. With white_at 0 every difference is white. Throws Error(kInput) if the sizes differ.
DisplayImage difference_picture(const Image& a, const Image& b, double white_at);

}  // namespace lobelia
