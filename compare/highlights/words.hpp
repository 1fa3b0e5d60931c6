// Sentences about highlights that were judged one by one.
#pragma once

#include "base/records/comparison.hpp"
#include "compare/highlights/judge.hpp"

namespace lobelia {

/// The worst 32, in the order given.
std::vector<records::LocalHighlight> highlights_record(std::span<const JudgedHighlight> judged);

/// "the highlight at (142, 92)", by its brightest pixel.
std::string name_of_highlight(int x, int y);

/// "the highlight at (142, 92) is gone", or "... has 30 % less light, is 2 % wider, lies 4 pixels to the left": a
/// sentence for each of the worst 8 that is off by more than the default limits, and how many more there are.
std::vector<std::string> sentences_on_highlights(
    std::span<const records::LocalHighlight> highlights);

}  // namespace lobelia
