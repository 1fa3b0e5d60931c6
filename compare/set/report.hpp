// The results of comparing a set of pairs, and their files: JSON, CSV and JUnit's XML.
#pragma once

#include "base/records/outcome.hpp"
#include "base/system/error.hpp"
#include "base/system/sha256.hpp"
#include "compare/layers.hpp"

namespace lobelia {

/// Hashes of the two files of a pair; nothing for one that changed while it was compared.
struct PairHashes {
  std::optional<Sha256Digest> a, b;
};

struct PairReport {
  std::string
      name;  ///< of the row, after the set's title and '/' if there are several to be judged
  std::string a, b, c;  ///< files; c is empty without a second reference
  std::optional<Comparison> comparison;
  std::string error;  ///< why there is no comparison; empty if there is one
  double seconds = 0;
  std::optional<PicturePairSource> sources = {};  ///< how both files were read
  std::optional<OtherLayers> layers = {};         ///< everything besides the display window
  std::size_t row = 0, set = 0;                   ///< of `a` in the Pairing
  std::string name_in_folders = {};  ///< of its pictures of noise; empty: they are given as files
  std::vector<std::string> references = {};  ///< all that are acceptable; `b` is the best of them
  std::optional<records::Known> known = {};  ///< what was said of its difference beforehand
  PairHashes hashes = {};                    ///< if they were asked for

  /// Whether it does not pass, and that counts as no failure.
  bool is_excused() const;
  /// The worst of the picture and its layers. There must be a comparison.
  Verdict verdict() const;
};

struct SetReport {
  std::string a, b, c;  ///< folders, or files of a single pair, or titles of sets
  std::vector<PairReport> pairs;
  std::vector<std::string> missing;            ///< names that only the reference has
  std::vector<std::string> extra;              ///< names without a reference
  std::size_t passed_over = 0;                 ///< files that are not pictures
  std::vector<std::string> not_followed = {};  ///< links to folders that may hold pictures
  std::vector<std::string> misnamed = {};      ///< files that nearly are frames of a sequence
  bool missing_reference_fails = false;        ///< `extra` are failures
};

using Outcome = records::Outcome;

Outcome outcome_of(const PairReport& pair);

/// The outcome of a pair or of a name.
struct NameOutcome {
  records::Outcome outcome;
  std::string name;
  const PairReport* pair = nullptr;  ///< if there are both pictures

  /// The outcome's name, or the verdict's of a pair that does not pass: "different".
  std::string_view word() const;
  /// Why it does not pass; empty if it does.
  std::string why() const;
};
/// The outcomes of all pairs in their order, then of all names without a pair. Summaries and reports follow from these.
std::vector<NameOutcome> outcomes(const SetReport& report);

records::SetSummary count(const SetReport& report);

/// "1 pair", "20 differ", "0 missing": the pairs, then every outcome that there is or that is usual.
struct CountedOutcome {
  std::optional<records::Outcome> outcome;  ///< nothing for all pairs
  std::size_t count = 0;
  std::string_view words;
};
std::vector<CountedOutcome> counted_outcomes(const SetReport& report);

/// "3 pairs: 2 pass, 1 differ, ...": the counts as a sentence.
std::string counts_text(const SetReport& report);

/// Everything that was not compared, over all pairs.
struct SetNotCompared {
  std::size_t pairs = 0;  ///< with anything not compared
  NotCompared all;
};
SetNotCompared not_compared(const SetReport& report);

/// How many times over its limit the worst figure is, of the picture and its layers; infinite if one was not measured.
double excess(const PairReport& pair);

/// "known until 2027-01-31: why", "known, but expired on 2026-01-31: why", or empty.
std::string known_text(const PairReport& pair);

/// kInput if a pair could not be compared or there are no pairs. Otherwise kDiffers if a pair differs or is missing, a
/// link was not followed, a file is misnamed, or a name without a reference fails. Otherwise kUndecided if a pair is.
/// Otherwise kSuccess: pairs that are excused do not fail.
ExitCode set_exit_code(const SetReport& report);

/// A metric over the pairs for which it was measured.
struct MetricSummary {
  std::string_view id;
  double mean = 0;
  double worst = 0;            ///< by the output's Better
  const PairReport* worst_at;  ///< the first pair with the worst value
};

/// A summary of every output that takes a limit, in the catalogue's order.
std::vector<MetricSummary> summarise(std::span<const PairReport> pairs);

/// The highlight's difference in an artist's words: "a's highlight is 4 % wider and 7 % dimmer, its energy equal; 0.5
/// pixels to the left". In place of that, faults that explain the difference: "a is clipped at 1 where b goes up to 12".
/// Empty if it was not measured.
std::string highlight_sentence(const Comparison& comparison, std::string_view a = "a",
                               std::string_view b = "b");

/// "is 0.02", or "was not measured (why)".
std::string value_text(const Comparison& comparison, const LimitResult& limit);

/// "rmse is 0.02, limit 0.001; ..." for the limits that fail, or the number of pixels that are not finite and the place
/// of the first, with the names of the files. Empty for a pass.
std::string why_not_pass(const Comparison& comparison, std::string_view file_a,
                         std::string_view file_b);
/// The same for all but the picture: "layer Z (depth): depth.background is 12, limit 0; layer N: only b has it".
std::string why_layers_differ(const PairReport& pair);
/// The same for the picture and its layers.
std::string why_not_pass(const PairReport& pair);

/// The record of a pair with a comparison, and of the whole set.
records::Comparison pair_record(const PairReport& pair);
records::ComparisonSet set_record(const SetReport& report);

/// RFC 4180: a header, then a line for each pair, missing name, extra name and link that was not followed. Each metric
/// that was measured for any pair has a column; missing values are empty.
std::string set_csv(const SetReport& report);

/// JUnit's XML: a test case for each pair (a failure, or an error if it could not be compared), a failure for each
/// missing name and each link that was not followed, and a skipped test for each extra name. An undecided pair is a
/// failure, or with `skip_undecided` a skipped test. An excused pair is a skipped test, with its reason.
std::string set_junit(const SetReport& report, bool skip_undecided);

/// Markdown for a pull request: a sentence, then a table of what does not pass, the worst first.
std::string set_markdown(const SetReport& report);

/// A line for each problem, in the words that GitHub Actions shows beside the change: "::error title=...::...".
std::string set_github(const SetReport& report);

/// Something to be said of a set besides its figures.
struct Problem {
  enum class Weight : std::uint8_t { kFails, kWarns, kNotice };
  Weight weight;
  std::string_view what;  ///< "differs", "missing", ...
  std::string name, why;
  const PairReport* pair = nullptr;  ///< of a pair with a comparison
};
/// The weight of a pair with a comparison; nothing if it passes.
std::optional<Problem::Weight> weight_of(const PairReport& pair);
/// All of them: first what could not be compared, then the pairs, the worst first, then what is no failure.
std::vector<Problem> problems(const SetReport& report);

}  // namespace lobelia
