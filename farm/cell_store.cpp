#include "farm/cell_store.hpp"

#include <algorithm>
#include <cmath>

#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/version.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

bool names_inputs(const fs::path& path, const std::string& kind, const Json& inputs) {
  if (!fs::exists(path)) return false;
  try {
    const Json record = read_record(path, kind);
    return record.contains("inputs") && record["inputs"] == inputs;
  } catch (const Error&) {
    return false;  // a broken record is made again
  }
}

}  // namespace

CellStore::CellStore(const fs::path& farm_directory, const Cell& cell)
    : cell_(&cell),
      directory_(farm_directory / "cells" / cell.id),
      scene_xml_(scene_to_xml(cell.scene)) {}

void CellStore::prepare() const {
  make_directories(directory_);
  remove_abandoned_files(directory_);
  write_file(file("scene.xml"), scene_xml_);
}

Json CellStore::inputs(const std::string& engine_version) const {
  Json inputs{{"program", kNameAndVersion}, {"scene", scene_xml_}};
  if (!engine_version.empty()) inputs["engine"] = engine_version;
  return inputs;
}

bool CellStore::has_current_image(const std::string& engine, const std::string& kind,
                                  const Json& inputs) const {
  return fs::exists(file(engine + ".exr")) && names_inputs(file(engine + ".json"), kind, inputs);
}

bool CellStore::is_finished(const Json& inputs) const {
  if (!names_inputs(file("cell.json"), "cell", inputs)) return false;
  const Json record = read_record(file("cell.json"), "cell");
  return record.contains("problems") && record["problems"].empty();
}

void CellStore::store_image(const std::string& engine, const Image& image,
                            const ImageMetadata& metadata, const Json& record) const {
  write_exr(file(engine + ".exr"), image, metadata);
  write_record(file(engine + ".json"), record);
}

double brightest(const Image& image) {
  double peak = 0;
  for (const float value : image.values())
    if (std::isfinite(value)) peak = std::max(peak, double(value));
  return peak;
}

double cell_exposure(const Image& ours) { return exposure_for_peak(brightest(ours)); }

}  // namespace lobelia
