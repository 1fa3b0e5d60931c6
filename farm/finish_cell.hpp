// The last step of a cell: its pictures for the eye, its comparisons, its profile, its record.
#pragma once

#include <string>
#include <vector>

#include "farm/cell_store.hpp"

namespace lobelia {

struct CellProblem {
  std::string engine, message;
};

/// Compares our picture with each of `references` (engines whose pictures are there) and writes
/// cell.json. Returns the cell's status: "pass", "differs" or "failed" (if there are problems).
std::string finish_cell(const CellStore& store, const std::vector<std::string>& references,
                        const std::vector<CellProblem>& problems, const Json& inputs);

}  // namespace lobelia
