// The errors of each highlight of a reference in another picture.
//
// Source:       ours.
// Formula:      with b the reference and a the judged picture, over the pixels that find.hpp says, which noise in a does not
//               choose:
//               level   of b: its median over the ring; of a: that, and the median of a - b over the ring. So a change of the
//                       surroundings is none of the highlight, and the part of its tail that lies there dims with it.
//               energy  sum of a - b over the core, each over its level, of the channel in which it is the largest, divided
//                       by that of b; for a shallow highlight by 0.4 of its whole light.
//               width   root of the ratio of second moments about b's centre, less 1, after a was scaled to the energy of
//                       b over the level. The pixels stay the same, so a widening moves less than all of it into the
//                       ratio; it is divided by the share that a small one does.
//               shift   difference of first moments, likewise.
//               All sums are linear in a, so noise in a moves them to neither side. Shifts are divided by the light over
//               the level that bounds the pixels, which makes them exact for small ones. A highlight with less than a tenth of its
//               light is gone: its energy says so, and width and shift are 0.
// Beyond:       what exceeds the slack of the highlight (slack.hpp).
#pragma once

#include <optional>

#include "compare/highlights/find.hpp"

namespace lobelia {

/// The errors that pass by default; they also weigh the three kinds to tell the worst.
inline constexpr double kEnergyLimit = 0.03, kWidthLimit = 0.03, kShiftLimit = 0.25;

struct LocalErrors {
  double energy = 0, width = 0;     ///< a / b - 1
  double shift_x = 0, shift_y = 0;  ///< pixels, to the right and down
  /// 0, 1 or 2 if that of R, G or B is the largest, and those of all together are less than half of it.
  std::optional<std::size_t> channel = {};
  bool gone = false;
  double energy_beyond = 0, width_beyond = 0, shift_beyond = 0;  ///< sizes, less the slack

  /// The largest of the three sizes beyond the slack, in units of the limits.
  double badness() const;
};

/// `a` and `b` of the size of the reference that the highlight is of.
LocalErrors judge_highlight(const Image& a, const Image& b, const LocalHighlight& highlight);

struct JudgedHighlight {
  const LocalHighlight* highlight = nullptr;
  LocalErrors errors;
};

/// Appends those of `a` that are gone in `b` and known twice as well as others must be, at most kMostHighlights.
/// judge_highlight() then judges b by them: their energy in a is greater by the light that b lacks, in units of their own.
/// Not those around a highlight of b that differs in any case, unless that is much broader. `highlights`: those of b, found
/// with the same `where` and `noise`.
void add_highlights_of_a(const Image& a, const Image& b, std::span<const std::uint8_t> where,
                         const HighlightNoise& noise, std::vector<LocalHighlight>& highlights);

/// The worst first; equally bad ones in the order given.
std::vector<JudgedHighlight> judge_highlights(const Image& a, const Image& b,
                                              std::span<const LocalHighlight> highlights);
/// The same highlights in other pictures of their size.
std::vector<JudgedHighlight> judge_again(const Image& a, const Image& b,
                                         std::span<const JudgedHighlight> highlights);

}  // namespace lobelia
