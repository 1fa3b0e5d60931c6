// The verdicts of a cell, made again from the figures and limits of its records.
#pragma once

#include <string>

#include "gallery/checked_cell.hpp"

namespace lobelia::gallery {

/// The verdict by its figures and limits, in the words of a record. A comparison without a limit never passes.
std::string judge(const records::Comparison& comparison, const Metrics& metrics);

/// Judges every comparison and then the cell. Where a record and its figures say different things the worse one
/// holds, and `contradictions` says so. A flaw of a file outweighs every verdict.
void judge_cell(CheckedCell& cell, const Metrics& metrics);

}  // namespace lobelia::gallery
