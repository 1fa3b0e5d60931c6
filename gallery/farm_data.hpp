// farm.json as data: the grid, the engines, the cells.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gallery/fields.hpp"
#include "gallery/status.hpp"

namespace lobelia::gallery {

/// The engine whose pictures are ours; all others are its references.
inline constexpr char kOurEngine[] = "lobelia";

struct AxisValue {
  std::string value, label;
};

struct GridAxis {
  std::string name;
  std::vector<AxisValue> values;
};

struct EngineEntry {
  std::string name, title;
  std::string short_title;  ///< the title's first word where that tells the engines apart
  std::string version;
  bool available = false;
  std::string why, install;  ///< where not available
};

struct CellEntry {
  std::string id;  ///< a plain name
  CellStatus status = CellStatus::kMissing;
  std::vector<int> at;  ///< index of its value on each axis; -1 where the axis does not know it
  /// "Phong (RDF) · cosine, exact · exponent 16": its labels in the order of the axes.
  std::string label;
};

struct FarmData {
  std::string title, grid, command, made_by;
  NamedTexts host;
  std::vector<GridAxis> axes;        ///< at least one
  std::vector<EngineEntry> engines;  ///< ours first
  std::vector<CellEntry> cells;
  std::map<std::vector<int>, std::size_t> cell_at;  ///< the first cell at each position

  const EngineEntry* find_engine(const std::string& name) const;
  /// The engine's title, or its name if farm.json does not know it.
  std::string engine_title(const std::string& name) const;
  /// The cell at these indices, or null.
  const CellEntry* find_cell(const std::vector<int>& at) const;
};

/// Throws Error(kInput), naming the file and the key.
FarmData read_farm(const std::filesystem::path& directory);

}  // namespace lobelia::gallery
