// A cell's records and pictures, after they were checked against their hashes and judged again. What is missing or
// broken becomes words in `problem` fields, so that one bad file costs its own place on the page and nothing else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gallery/evidence.hpp"
#include "gallery/picture.hpp"
#include "gallery/shown_farm.hpp"
#include "records/comparison.hpp"
#include "records/farm.hpp"
#include "records/pages.hpp"
#include "records/profile.hpp"
#include "records/render.hpp"

namespace lobelia::gallery {

/// One engine's picture of the cell and how it was made.
struct EnginePicture {
  std::string engine;
  Picture png;
  std::string exr, record, log;  ///< plain names of files that exist; else empty
  std::string exr_sha256;        ///< empty without a file
  std::string float_script;  ///< published beside the page, with its values (float_pictures.hpp)
  std::string problem;       ///< why its record cannot be read
  std::string made_by;
  std::optional<records::Render> render;        ///< of ours
  std::optional<records::Reference> reference;  ///< of everybody else's
};

struct CheckedComparison {
  records::CellComparison entry;  ///< a and b are engines
  Picture png;
  records::Comparison record;
  std::string problem;                  ///< why its record cannot be read; it is empty then
  std::string verdict;                  ///< of its record, or of its figures if that is worse
  std::optional<CellStatus> doubt;      ///< the flaw of its record or of a picture that it is of
  std::vector<records::ShownMap> maps;  ///< published beside the page (difference_maps.hpp)

  std::optional<double> metric(const std::string& id) const;
};

struct CheckedCell {
  std::string id;
  CellStatus status = CellStatus::kMissing;
  std::string unreadable;  ///< why cell.json cannot be read; then nothing below is filled
  std::vector<Flaw> flaws;
  std::vector<std::string> contradictions;  ///< sentences: a record says what its figures do not
  bool is_sealed = true;                    ///< every file that it names has its hash
  bool has_record = false;
  std::string made_by;
  records::Cell record;
  std::vector<EnginePicture> images;
  std::vector<CheckedComparison> comparisons;
  std::optional<records::Profile> profile;
  std::string profile_problem;  ///< why it cannot be read
  bool has_scene = false;

  const EnginePicture* find_image(const std::string& engine) const;
  const CheckedComparison* find_comparison(const std::string& b) const;
};

/// Reads DIR/cells/ID/cell.json and all that it names, and judges it again. A file that is not as it was is not used.
/// `entry` is the cell's line in farm.json.
CheckedCell check_cell(const std::filesystem::path& directory, const CellEntry& entry,
                       const Metrics& metrics);

/// Plain names of all files of the cell's directory that its page may show or link to.
std::vector<std::string> files_of(const CheckedCell& cell);

}  // namespace lobelia::gallery
