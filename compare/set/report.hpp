// What became of a set of pairs, and the files that tell it: JSON, CSV and JUnit's XML.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/compare.hpp"
#include "compare/layers.hpp"
#include "core/error.hpp"

namespace lobelia {

struct PairReport {
  std::string name;     ///< what both are called: the file's path within its folder
  std::string a, b, c;  ///< files; c is empty without a second reference
  std::optional<Comparison> comparison;
  std::string error;  ///< why there is no comparison; empty if there is one
  double seconds = 0;
  std::optional<PicturePairSource> sources = {};  ///< how both files were read
  std::optional<OtherLayers> layers = {};         ///< what was compared besides, and what was not

  /// The worst of the picture and its layers; `comparison` has to be there.
  Verdict verdict() const;
};

struct SetReport {
  std::string a, b, c;  ///< folders, or files of a single pair
  std::vector<PairReport> pairs;
  std::vector<std::string> missing;  ///< names that only the reference has: nothing to judge
  std::vector<std::string> extra;    ///< names that have no reference
  std::size_t passed_over = 0;       ///< files that are no pictures
  std::vector<std::string> not_followed = {};  ///< links to folders that may hold pictures
};

/// Why such a link fails.
inline constexpr std::string_view kNotFollowed =
    "a link to a folder elsewhere; its pictures were not compared";

records::SetSummary count(const SetReport& report);

/// Everything that was not compared, over all pairs.
struct SetNotCompared {
  std::size_t pairs = 0;  ///< that have something
  NotCompared all;
};
SetNotCompared not_compared(const SetReport& report);

/// kInput if a pair could not be compared or there is none at all, else kDiffers if one is not a pass or
/// is missing, or a link was not followed, else kSuccess. What has no reference is named, but does not fail.
ExitCode set_exit_code(const SetReport& report);

/// A metric over the pairs that have it.
struct MetricSummary {
  std::string_view id;
  double mean = 0;
  double worst = 0;            ///< furthest the way that is not its Better
  const PairReport* worst_at;  ///< the first pair that has it
};

/// A summary of every metric that is not a fact, in the catalogue's order.
std::vector<MetricSummary> summarise(std::span<const PairReport> pairs);

/// "is 0.02", or "was not measured (why)".
std::string value_text(const Comparison& comparison, const LimitResult& limit);

/// "rmse is 0.02, limit 0.001; ..." of the limits that fail, or how many pixels are not finite and where the
/// first one is, by the names of the files; empty for a pass.
std::string why_not_pass(const Comparison& comparison, std::string_view file_a,
                         std::string_view file_b);
/// The same of the picture and its layers.
std::string why_not_pass(const PairReport& pair);

/// The record of a pair that has a comparison, and of all.
records::Comparison pair_record(const PairReport& pair);
records::ComparisonSet set_record(const SetReport& report);

/// RFC 4180: a header, then a line for each pair, missing name, extra name and link that was not followed. It has a
/// column for each metric that any pair has; a missing value is empty.
std::string set_csv(const SetReport& report);

/// JUnit's XML: a test case for each pair (failure, or error where it could not be compared), a failure
/// for each missing name and each link that was not followed, a skipped one for each extra one.
std::string set_junit(const SetReport& report);

}  // namespace lobelia
