// A cell's records and pictures, checked against their hashes and judged again. A missing or broken file becomes a
// sentence in a `problem` field and is left out; the rest of the cell's page is shown.
#pragma once

#include "base/records/comparison.hpp"
#include "base/records/pages.hpp"
#include "base/records/profile.hpp"
#include "base/records/render.hpp"
#include "gallery/cells/picture.hpp"
#include "gallery/cells/shown_farm.hpp"

namespace lobelia::gallery {

/// A fault of a file that a verdict depends on.
struct Flaw {
  std::string file;     ///< a plain name
  CellStatus status;    ///< kDamaged, kLost or kChanged
  std::string message;  ///< a sentence that names the file
};

/// One engine's picture of the cell and how it was made.
struct EnginePicture {
  std::string engine;
  Picture png;
  std::string exr, record, log;  ///< plain names of files that exist; else empty
  std::string exr_sha256;        ///< empty without a file
  std::string float_script;  ///< published beside the page, with its values (float_pictures.cpp)
  std::string problem;       ///< why its record cannot be read
  std::string made_by;
  records::Named<std::string> facts;      ///< of a report's picture: its file, and how it was read
  std::optional<records::Render> render;  ///< set for our picture
  std::optional<records::Reference> reference;  ///< set for the other engines' pictures
};

struct CheckedComparison {
  records::CellComparison entry;  ///< a and b are engines
  Picture png;
  records::Comparison record;
  std::string problem;                  ///< why its record cannot be read; then `record` is empty
  std::string verdict;                  ///< of its record, or by its figures if that is worse
  std::optional<CellStatus> doubt;      ///< a flaw of its record or of one of its two pictures
  std::vector<records::ShownMap> maps;  ///< published beside the page (difference_maps.cpp)
  std::string region;    ///< likewise, the pixels of the highlight; empty: there are none
  std::string sentence;  ///< what an artist would say of the highlight; may be empty

  std::optional<double> metric(const std::string& id) const;
};

struct CheckedCell {
  std::string id;
  std::string hub = kOurEngine;  ///< as ShownFarm has it
  CellStatus status = CellStatus::kMissing;
  std::string unreadable;  ///< why cell.json cannot be read; then nothing below is filled
  std::vector<Flaw> flaws;
  std::vector<std::string>
      contradictions;     ///< sentences: a record's verdict is not that of its figures
  bool is_sealed = true;  ///< cell.json has a hash of every file it names
  bool has_record = false;
  std::string made_by;
  records::Cell record;
  std::vector<EnginePicture> images;
  std::vector<CheckedComparison> comparisons;
  std::optional<records::Profile> profile;
  std::string profile_problem;  ///< why the profile cannot be read
  bool has_scene = false;
  SmallPicture thumbnail = {};  ///< made by the gallery

  const EnginePicture* find_image(const std::string& engine) const;
  /// The engine that a comparison has besides the hub.
  const std::string& other_of(const CheckedComparison& comparison) const {
    return comparison.entry.a == hub ? comparison.entry.b : comparison.entry.a;
  }
  const CheckedComparison* find_comparison(const std::string& other) const;
};

/// Reads DIR/cells/ID/cell.json and every file it names, and judges the cell again. Files with a flaw are not used.
/// `entry` is the cell's line in farm.json, `hub` is ShownFarm::hub, `texts` ShownFarm::texts.
CheckedCell check_cell(const std::filesystem::path& directory, const CellEntry& entry,
                       const Metrics& metrics, const std::string& hub = kOurEngine,
                       const PublishedTexts* texts = nullptr);

/// Plain names of all files of the cell's directory that its page may show or link to.
std::vector<std::string> files_of(const CheckedCell& cell);

/// The verdict by a comparison's figures and limits, as a record names it. Without a limit it never passes.
std::string judge(const records::Comparison& comparison, const Metrics& metrics);

/// The rank of a verdict, or of a state in a farm's record: higher is worse.
int rank(const std::string& verdict);
std::size_t rank(CellStatus status);

/// Judges every comparison and then the cell. Where a record's verdict is not that of its figures, the worse one holds
/// and `contradictions` gets a sentence. A flaw of a file outweighs every verdict.
void judge_cell(CheckedCell& cell, const Metrics& metrics);

}  // namespace lobelia::gallery
