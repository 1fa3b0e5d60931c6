// A farm's directory without a farm: records as docs/records.md lays them out, and tiny pictures.
#pragma once

#include <filesystem>
#include <string>

#include "core/files.hpp"
#include "core/record.hpp"

namespace lobelia::gallery {

/// Two models x two exponents x one light. POV-Ray is there, Blender is missing. The four cells are
/// in the four states of a farm; the missing one has no directory.
class FakeFarm {
 public:
  FakeFarm();

  const std::filesystem::path& directory() const { return temporary_.path(); }
  std::filesystem::path cell_directory(const std::string& id) const;
  Json& farm() { return farm_; }
  /// Writes farm.json again after a change of farm().
  void write() const;
  /// One record of a cell: read, changed by `change`, written again as if the farm had written it so.
  template <class Change>
  void change(const std::string& id, const std::string& file, const std::string& kind,
              Change change) const {
    const auto path = cell_directory(id) / file;
    Json record = read_record(path, kind);
    change(record);
    write_record(path, record);
    seal(id);
  }
  /// Puts the hashes of the files that are there now into cell.json.
  void seal(const std::string& id) const;
  /// Adds a cell to farm.json, with records and pictures; its engine's pictures and comparisons
  /// too.
  void add_cell(const std::string& id, const std::string& status, const Json& axes);

  static inline const std::string kPass = "phong_rdf-n16";
  static inline const std::string kDiffers = "phong_rdf-n128";
  static inline const std::string kFailed = "blinn_phong_ndf-n16";
  static inline const std::string kMissing = "blinn_phong_ndf-n128";

 private:
  TemporaryDirectory temporary_;
  Json farm_;
};

/// A complete PNG of 2 x 2 pixels.
std::string tiny_png();

}  // namespace lobelia::gallery
