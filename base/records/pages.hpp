// Data for the scripts of the gallery's pages. They are not records, because program and script always have the same
// version.
#pragma once

#include "base/records/models.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct GridAxis {
  std::string name;
  std::vector<std::string> values;
};

struct GridEngine {
  std::string name, title, short_title;
};

struct GridLayout {
  int rows = -1, groups = -1, columns = -1;
};

struct GridStatus {
  std::string name, word, mark;
};

struct GridChange {
  std::string name, word, mark;
};

struct GridPicture {
  std::string file;
  int width = 0, height = 0;
};

struct GridMetric {
  std::string id, title, meaning, unit;
  bool more_is_better = false;
};

struct GridColumn {
  int engine = 0;
  std::string values, limits;
};

struct GridColumns {
  int metric = 0;
  std::vector<GridColumn> engines;
};

struct GridLabel {
  int cell = 0;
  std::string label;
};

struct GridPage {
  std::string noun;
  std::vector<GridAxis> axes;
  std::vector<GridEngine> engines;
  GridLayout layout;
  std::vector<GridStatus> statuses;
  std::vector<GridMetric> metrics;
  std::vector<GridPicture> pictures;
  std::vector<std::string> ids;
  std::vector<int> at, status, picture, place;
  std::vector<GridLabel> labels;
  std::vector<std::vector<int>> beside;
  std::vector<std::string> findings;
  std::vector<GridChange> changes;
  std::vector<int> change;
  std::vector<GridColumns> columns;
};

struct ShownPicture {
  std::string src, small;
  int width = 0, height = 0;
};

struct ShownEngine {
  std::string name, title, short_title;
  std::optional<ShownPicture> picture;
  std::string float_script, before_of;
};

struct ShownMap {
  std::string id, title, meaning, script;
  double top = 1;
};

struct ShownComparison {
  std::string a, b;
  std::optional<ShownPicture> picture;
  std::optional<double> white_at;
  std::vector<ShownMap> maps;
  std::optional<double> worst_x, worst_y;
  std::string region;
};

struct ShownZone {
  std::string title;
  double from = 0, to = 0;
};

struct ShownCurve {
  std::string name;
  std::vector<double> values;
};

struct ShownProfile {
  std::string angle;
  std::vector<double> degrees;
  std::vector<ShownZone> zones;
  std::vector<ShownCurve> curves;
  std::vector<std::string> from_formula;
};

struct CellPage {
  std::string id, label;
  bool is_report = false;
  std::optional<double> exposure_stops;
  std::vector<ShownEngine> engines;
  std::vector<ShownComparison> comparisons;
  std::optional<ShownProfile> profile;
};

/// Pixels of a picture.
struct PixelRuns {
  int width = 0, height = 0;
  std::vector<int> runs;
};

struct PackedPicture {
  int width = 0, height = 0;
  bool from_ours = false;
  int block = 1, scale_log2 = 0, mantissa_bits = 0;
  double least = 0;
  bool predicted = false;
  std::string planes;
};

struct PackedShown {
  std::string file;
  int width = 0, height = 0, way = 0;
};

struct PackedCell {
  std::string id, main;
  CellPage page;
  std::vector<PackedShown> pictures;
  std::vector<int> counts;
};

struct CellTexts {
  std::vector<PackedCell> cells;
};

struct CellChunk {
  std::string texts, curves;
  std::vector<std::string> pixels;
};

struct CellIndex {
  std::vector<std::string> first;
};

struct Thumbnails {
  std::vector<int> widths, heights, ways;
  std::string pixels;
};

/// A page of a report in one file.
struct InlinedPage {
  std::string view, title, main;
};

struct ExplorerPage {
  HighlightTables tables;
  std::string search;
};

void define_page_tables(Tables& tables);

}  // namespace lobelia::records
