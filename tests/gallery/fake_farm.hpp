// A farm's directory without a farm: records as a farm writes them, and tiny pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/records/farm.hpp"
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "gallery/cells/metrics.hpp"

namespace lobelia::gallery {

/// Two models x two exponents x one light. POV-Ray is there, Blender is missing. The four cells are
/// in the four states of a farm; the missing one has no directory.
class FakeFarm {
 public:
  FakeFarm();

  const std::filesystem::path& directory() const { return temporary_.path(); }
  std::filesystem::path cell_directory(const std::string& id) const;
  records::Farm& farm() { return farm_; }
  /// Writes farm.json again after a change of farm().
  void write() const;
  /// One record of a cell: read, changed by `change`, written again as if the farm had written it so.
  template <class T, class Change>
  void change(const std::string& id, const std::string& file, Change change) const {
    const auto path = cell_directory(id) / file;
    T record = records::read_record<T>(path);
    change(record);
    records::write_record(path, record);
    if (file != kCellRecord) seal(id);
  }
  /// Puts the hashes of the files that are there now into cell.json.
  void seal(const std::string& id) const;
  /// Adds a cell to farm.json, with records and pictures; its engine's pictures and comparisons
  /// too.
  void add_cell(const std::string& id, const std::string& status,
                const records::Named<std::string>& axes);
  /// Takes cells out of farm.json; their directories stay.
  void leave_out(const std::vector<std::string>& ids);

  static inline const std::string kPass = "phong_rdf-n16";
  static inline const std::string kDiffers = "phong_rdf-n128";
  static inline const std::string kFailed = "blinn_phong_ndf-n16";
  static inline const std::string kMissing = "blinn_phong_ndf-n128";
  static inline const std::string kCellRecord = "cell.json";

 private:
  TemporaryDirectory temporary_;
  records::Farm farm_;
};

/// The command line's information on a few metrics.
std::vector<MetricInfo> some_metrics();

/// A complete PNG of 2 x 2 pixels.
std::string tiny_png();

}  // namespace lobelia::gallery
