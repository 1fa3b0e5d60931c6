// What the scripts of the gallery's pages are given. They are no records: program and script are of one version.
#pragma once

#include "records/models.hpp"
#include "records/paper.hpp"
#include "records/stability.hpp"
#include "records/struct_type.hpp"

namespace lobelia::records {

struct GridAxis {
  std::string name;
  std::vector<std::string> values;
  static const Struct& type();
};

struct GridEngine {
  std::string name, title, short_title;
  static const Struct& type();
};

struct GridLayout {
  int rows = -1, groups = -1, columns = -1;
  static const Struct& type();
};

struct GridStatus {
  std::string name, word, mark;
  static const Struct& type();
};

struct GridPicture {
  std::string src;
  int width = 0, height = 0;
  static const Struct& type();
};

struct GridCell {
  std::string id, label, href, status;
  std::vector<int> at;
  Named<std::vector<std::optional<double>>> metrics;
  std::optional<GridPicture> picture;
  static const Struct& type();
};

struct GridMetric {
  std::string id, title, meaning, unit;
  bool more_is_better = false;
  static const Struct& type();
};

struct GridPage {
  std::vector<GridAxis> axes;
  std::vector<GridEngine> engines;
  GridLayout layout;
  std::vector<GridStatus> statuses;
  std::vector<GridCell> cells;
  std::vector<GridMetric> metrics;
  static const Struct& type();
};

struct ShownPicture {
  std::string src, small;
  int width = 0, height = 0;
  static const Struct& type();
};

struct ShownEngine {
  std::string name, title, short_title;
  std::optional<ShownPicture> picture;
  std::string float_script;
  static const Struct& type();
};

struct ShownMap {
  std::string id, title, meaning, script;
  static const Struct& type();
};

struct ShownComparison {
  std::string a, b;
  std::optional<ShownPicture> picture;
  std::optional<double> white_at, relative_to_peak;
  std::vector<ShownMap> maps;
  std::optional<double> worst_x, worst_y;
  static const Struct& type();
};

struct ShownZone {
  std::string title;
  double from = 0, to = 0;
  static const Struct& type();
};

struct ShownCurve {
  std::string name;
  std::vector<double> values;
  static const Struct& type();
};

struct ShownProfile {
  std::string angle;
  std::vector<double> degrees;
  std::vector<ShownZone> zones;
  std::vector<ShownCurve> curves;
  static const Struct& type();
};

struct CellPage {
  std::string id, label;
  std::optional<double> exposure_stops;
  std::vector<ShownEngine> engines;
  std::vector<ShownComparison> comparisons;
  std::optional<ShownProfile> profile;
  static const Struct& type();
};

struct PackedPicture {
  int width = 0, height = 0;
  bool from_ours = false;
  int block = 1, scale_log2 = 0, mantissa_bits = 0;
  double least = 0;
  bool predicted = false;
  std::string planes;
  static const Struct& type();
};

struct StabilitySummary {
  std::string group, lobe;
  double exponent = 0;
  std::array<double, 2> naive{}, ours{};
  static const Struct& type();
};

struct StabilityPage {
  std::vector<StabilitySummary> summaries;
  std::vector<StabilityCurve> curves;
  static const Struct& type();
};

struct PaperPage {
  std::vector<PaperFigure> charts;
  static const Struct& type();
};

/// The explorer's, as HighlightTables; its rows are kept as second differences.
using ExplorerPage = HighlightTables;

}  // namespace lobelia::records
