// A cell's records as data. What is missing or broken becomes words in `problem` fields, so that
// one bad file costs its own place on the page and nothing else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gallery/evidence.hpp"
#include "gallery/farm_data.hpp"
#include "gallery/picture.hpp"
#include "gallery/profile_data.hpp"

namespace lobelia::gallery {

struct PlannedEffect {
  std::string name;
  bool on = false;
  std::string reason;
};

/// One engine's picture of the cell and how it was made.
struct CellImage {
  std::string engine;
  Picture png;
  std::string exr, record, log;  ///< plain names of files that exist; else empty
  std::string exr_sha256;        ///< empty without a file
  std::string float_script;  ///< published beside the page, with its values (float_pictures.hpp)
  std::string problem;       ///< why its record cannot be read
  std::string made_by, version, witness;
  std::string command;  ///< as a shell reads it
  std::vector<std::string> engine_commands;
  NamedNumbers seconds;
  NamedTexts facts;  ///< rays, passes, instruction set: printed, not understood
  std::vector<PlannedEffect> effects;
};

struct MetricLimit {
  std::string metric;
  double limit = 0, value = 0;
  bool pass = false;
  bool noisy = false;  ///< judged by its error bar
  bool open = false;   ///< it is up to the noise
};

/// What a metric would be with endless samples lies between; `floor` is what the noise alone shows, in the mean.
struct ErrorBar {
  std::string metric;
  double low = 0, high = 0, floor = 0;
};

struct Tolerance {
  std::optional<double> relative, of_peak, allowed_outliers;
};

/// A difference for each pixel, published beside the page (difference_maps.hpp).
struct PublishedMap {
  std::string id, title, meaning;
  std::string script;
};

struct CellComparison {
  std::string a, b;  ///< engines
  Picture png;
  std::string record;
  std::string problem;
  std::optional<double> white_at, relative_to_peak;
  std::string verdict;              ///< of its record, or of its figures if that is worse
  std::optional<CellStatus> doubt;  ///< the flaw of its record or of a picture that it is of
  std::optional<double> nonfinite_a, nonfinite_b;
  NamedNumbers metrics;
  std::vector<MetricLimit> limits;
  std::vector<ErrorBar> error_bars;  ///< where the noise is known
  std::optional<Tolerance> tolerance;
  NamedTexts viewing;
  std::optional<double> exposure_stops, pixels_per_degree;  ///< the same of a plain sRGB display
  std::vector<PublishedMap> maps;

  std::optional<double> metric(const std::string& id) const;
};

struct CellProblem {
  std::string engine;  ///< may be empty: it concerns the cell as a whole
  std::string message;
};

struct CellData {
  std::string id;
  CellStatus status = CellStatus::kMissing;
  std::string unreadable;  ///< why cell.json cannot be read; then nothing below is filled
  std::vector<Flaw> flaws;
  std::vector<std::string> contradictions;  ///< sentences: a record says what its figures do not
  bool is_sealed = true;                    ///< every file that it names has its hash
  bool has_record = false;
  std::string made_by;
  NamedTexts highlight;
  std::optional<double> exposure_stops;
  std::vector<CellImage> images;
  std::vector<CellComparison> comparisons;
  ProfileData profile;
  std::vector<CellProblem> problems;
  std::vector<CellProblem> not_comparable;  ///< the message says because of what
  bool has_scene = false;

  const CellImage* find_image(const std::string& engine) const;
  const CellComparison* find_comparison(const std::string& b) const;
};

/// Reads DIR/cells/ID/cell.json and all that it names, and judges it again. A file that is not as it was is not used.
/// `entry` is the cell's line in farm.json.
CellData read_cell(const std::filesystem::path& directory, const CellEntry& entry);

/// Plain names of all files of the cell's directory that its page may show or link to.
std::vector<std::string> files_of(const CellData& cell);

}  // namespace lobelia::gallery
