// What the index says of a cell.
#pragma once

#include <string>
#include <vector>

#include "gallery/checked_cell.hpp"

namespace lobelia::gallery {

struct EngineFigure {
  std::string engine;  ///< short title
  std::string worst;   ///< "0.049 %", or in a word why there is none
  std::string note;    ///< "2 px": pixels beyond the tolerance, if any
};

struct CellSummary {
  const CellEntry* entry = nullptr;
  CellStatus status = CellStatus::kMissing;
  bool is_as_written =
      true;         ///< nothing was found that the farm did not write, or that contradicts itself
  Picture picture;  ///< ours
  std::vector<EngineFigure> figures;  ///< one per reference engine that is there
  std::vector<std::string> reasons;   ///< why it is not a pass
  /// Of each engine that was compared with ours, all metrics but coordinates.
  records::Named<records::Named<double>> metrics;
};

CellSummary summarise(const ShownFarm& farm, const CellEntry& entry, const CheckedCell& cell);

}  // namespace lobelia::gallery
