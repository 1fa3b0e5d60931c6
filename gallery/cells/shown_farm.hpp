// farm.json, with labels and the place of each cell on the grid.
#pragma once

#include <filesystem>
#include <map>

#include "base/records/farm.hpp"
#include "gallery/cells/metrics.hpp"
#include "gallery/cells/status.hpp"
#include "gallery/site/published_texts.hpp"

namespace lobelia::gallery {

/// The engine of a farm's own pictures.
inline constexpr char kOurEngine[] = "lobelia";

struct CellEntry {
  std::string id;  ///< a plain name
  CellStatus status = CellStatus::kMissing;
  /// Index of its value on each axis; -1 for a value that the axis does not list.
  std::vector<int> at;
  /// "Phong (RDF) · cosine, exact · exponent 16": its labels in the order of the axes.
  std::string label;

  const std::string& title() const { return label.empty() ? id : label; }
};

struct ShownFarm {
  records::Farm record;          ///< no title and no label is empty
  std::string hub = kOurEngine;  ///< the engine whose picture is compared with each other's
  /// Pictures from anywhere that `lobelia compare` has just compared: there are no scenes, no plans and no hashes.
  bool is_report = false;
  std::string made_by;
  Metrics metrics;
  std::shared_ptr<const PublishedTexts>
      texts;                     ///< of all records of the run; null: they are shown as they are
  std::vector<CellEntry> cells;  ///< in the record's order
  std::map<std::vector<int>, std::size_t> cell_at;  ///< the first cell at each position

  /// For a report: its counts in the words of the summary, such as 20 and "differ".
  std::vector<std::pair<std::size_t, std::string>> counts = {};
  /// "cell"; of a report "pair", or where a picture has no partner "name".
  std::string_view noun() const;
  /// A status in the words for a cell, or for a report's pair.
  StatusInfo words_of(CellStatus status) const {
    return is_report ? info_of_pair(status) : info(status);
  }
  /// The engine's title, or its name if farm.json does not know it.
  std::string engine_title(const std::string& name) const;
  /// The title's first word if that tells the engines apart, else the title.
  std::string short_title(const records::FarmEngine& engine) const;
  /// The cell at these indices, or null.
  const CellEntry* find_cell(const std::vector<int>& at) const;
};

/// With titles and the place of each cell. The ids of the cells are plain names, each used once.
ShownFarm show(records::Farm record, const Metrics& metrics);

/// Throws Error(kInput), naming the file and the key.
ShownFarm read_farm(const std::filesystem::path& directory, const Metrics& metrics = {},
                    std::shared_ptr<const PublishedTexts> texts = nullptr);

}  // namespace lobelia::gallery
