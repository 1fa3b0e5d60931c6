// The last step of a cell: its pictures for the eye, its comparisons, its profile, its record.
#pragma once

#include <string>
#include <vector>

#include "farm/cell_store.hpp"

namespace lobelia {

inline constexpr char kOurs[] = "lobelia";  ///< our name among the engines

struct CellProblem {
  std::string engine, message;
};

/// Compares our picture with each of `references` (engines whose pictures are there) and writes
/// cell.json. Returns the cell's status: "pass", "differs", "failed" (if there are problems),
/// "undecided" (none differs, and a comparison is up to the noise) or "unchecked" (nothing to compare with).
/// Pictures with noise are judged by their standard errors. `not_comparable` is of engines that cannot show the
/// scene; where errors are not there it is added to. A reference that cannot be read is a problem, added to `problems`;
/// throws Error(kInput) if ours cannot. What cannot be read is discarded, to be made again.
std::string finish_cell(const CellStore& store, const std::vector<std::string>& references,
                        std::vector<CellProblem> not_comparable, std::vector<CellProblem>& problems,
                        const Json& inputs);

}  // namespace lobelia
