// Outcomes for the names of a set of pictures, in the words of every report: summary, page, CSV, JUnit, Markdown and
// Python.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lobelia::records {

/// In the order of the summary.
enum class Outcome : std::uint8_t {
  kPass,
  kDiffers,
  kKnown,
  kUndecided,
  kNonFinite,
  kError,
  kMissing,
  kMisnamed,
  kNotFollowed,
  kExtra
};
inline constexpr std::size_t kOutcomes = 10;

struct OutcomeInfo {
  std::string_view name;     ///< "differs"; of pairs with noise the verdict's name counts
  std::string_view counted;  ///< "differ", as in "20 differ"
  std::string_view meaning;  ///< one sentence
  bool is_pair = true;       ///< counts as a pair: both pictures are there
  bool is_usual = false;     ///< is counted even where there is none
};

/// In the order of Outcome.
inline constexpr std::array<OutcomeInfo, kOutcomes> kOutcomeInfos{{
    {"pass", "pass", "The pictures agree within the limits.", true, true},
    {"differs", "differ", "At least one number is over its limit.", true, true},
    {"known", "known to differ",
     "It does not pass, and the project says why; that counts as no failure until it expires.",
     true},
    {"undecided", "undecided",
     "The noise leaves it open whether they differ: more samples are needed.", true},
    {"non-finite", "not finite",
     "A picture has a NaN or an infinity, so nothing was measured and nothing can pass.", true,
     true},
    {"error", "errors", "A picture cannot be read, or the two cannot be compared.", true, true},
    {"missing", "missing", "There is only a reference.", false, true},
    {"misnamed", "misnamed",
     "Nearly a frame of the sequence, but written in another way; it was not compared.", false},
    {"not followed", "links not followed",
     "A link to a folder elsewhere; its pictures were not compared.", false},
    {"extra", "extra", "There is no reference.", false, true},
}};

constexpr const OutcomeInfo& info(Outcome outcome) { return kOutcomeInfos[std::size_t(outcome)]; }

}  // namespace lobelia::records
