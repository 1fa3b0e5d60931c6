// One cell's directory: what lies there, and whether it is still what would be made today.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/record.hpp"
#include "farm/grid.hpp"

namespace lobelia {

/// The inputs of a result stand in its record in full ("inputs"); a result is current if they are
/// equal to today's. No hashes: a person can read why something was made again.
class CellStore {
 public:
  CellStore(const std::filesystem::path& farm_directory, const Grid& grid, const Cell& cell);

  const Cell& cell() const { return *cell_; }
  const Scene& scene() const { return scene_; }
  std::filesystem::path file(const std::string& name) const { return directory_ / name; }

  /// Makes the directory, writes scene.xml, removes what a killed run left behind and the cell's
  /// record, which speaks of results that are about to change. With `again` also the pictures'
  /// records, so that none of them counts as current before it has been made again.
  void prepare(bool again) const;

  /// {"program": ..., "scene": the scene's text}, and the engine with its version if there is one.
  Json inputs(const std::string& engine_version) const;

  /// Whether `engine`'s picture is there, whole, and its record names these inputs.
  bool has_current_image(const std::string& engine, const std::string& kind,
                         const Json& inputs) const;
  /// The status in cell.json, if that is there without problems, names these inputs, and every file
  /// that it names is there too; otherwise empty.
  std::string finished_status(const Json& inputs) const;
  /// Removes the record of a picture that turned out to be unreadable: it will be made again.
  void discard_image(const std::string& engine) const;

  /// Writes the picture, that of its standard errors unless it is empty, then its record, because that says that
  /// they are there.
  void store_image(const std::string& engine, const Image& image, const Image& standard_error,
                   const ImageMetadata& metadata, Json record) const;

 private:
  const Cell* cell_;
  Scene scene_;
  std::filesystem::path directory_;
  std::string scene_xml_;
};

/// The name of the picture of standard errors beside an engine's picture.
std::string error_file(const std::string& engine);

/// The exposure at which a cell is looked at: the brightest value of our picture becomes white.
double cell_exposure(const Image& ours);

/// The brightest finite value of a picture, at least 0.
double brightest(const Image& image);

}  // namespace lobelia
