#include "farm/cell_store.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "compare/metrics/metric.hpp"
#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/version.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// The record at `path` if it is there and names these inputs; a broken one is made again.
std::optional<Json> current_record(const fs::path& path, const std::string& kind,
                                   const Json& inputs) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  try {
    Json record = read_record(path, kind);
    if (record.contains("inputs") && record["inputs"] == inputs) return record;
  } catch (const Error&) {
  }
  return std::nullopt;
}

std::uintmax_t size_of(const fs::path& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return error ? 0 : size;
}

/// Every file that a cell's record names.
std::vector<std::string> named_files(const Json& record) {
  std::vector<std::string> files;
  for (const char* list : {"images", "comparisons"})
    for (const auto& entry : record.at(list))
      for (const char* key : {"exr", "png", "record"})
        if (entry.contains(key)) files.push_back(entry.at(key).get<std::string>());
  if (record.contains("profile")) files.push_back(record.at("profile").get<std::string>());
  return files;
}

}  // namespace

CellStore::CellStore(const fs::path& farm_directory, const Grid& grid, const Cell& cell)
    : cell_(&cell),
      scene_(scene_of(grid, cell)),
      directory_(farm_directory / "cells" / cell.id),
      scene_xml_(scene_to_xml(scene_)) {}

void CellStore::prepare(bool again) const {
  make_directories(directory_);
  remove_abandoned_files(directory_);
  std::error_code ignored;
  if (again) {
    for (const auto& entry : fs::directory_iterator(directory_, ignored))
      if (entry.path().extension() == ".json") fs::remove(entry.path(), ignored);
  }
  fs::remove(file("cell.json"), ignored);
  write_file(file("scene.xml"), scene_xml_);
}

Json CellStore::inputs(const std::string& engine_version) const {
  Json inputs{{"program", kNameAndVersion}, {"scene", scene_xml_}};
  if (!engine_version.empty()) inputs["engine"] = engine_version;
  return inputs;
}

bool CellStore::has_current_image(const std::string& engine, const std::string& kind,
                                  const Json& inputs) const {
  const auto record = current_record(file(engine + ".json"), kind, inputs);
  if (record && record->contains("standardError") && size_of(file(error_file(engine))) == 0)
    return false;
  return record && record->contains("bytes") && size_of(file(engine + ".exr")) > 0 &&
         record->at("bytes") == size_of(file(engine + ".exr"));
}

std::string CellStore::finished_status(const Json& inputs) const {
  const auto record = current_record(file("cell.json"), "cell", inputs);
  if (!record) return "";
  try {
    if (!record->at("problems").empty()) return "";
    for (const auto& name : named_files(*record))
      if (size_of(file(name)) == 0) return "";
    return record->at("status").get<std::string>();
  } catch (const Json::exception&) {
    return "";  // not a record that we wrote
  }
}

void CellStore::discard_image(const std::string& engine) const {
  std::error_code ignored;
  fs::remove(file(engine + ".json"), ignored);
}

void CellStore::store_image(const std::string& engine, const Image& image,
                            const Image& standard_error, const ImageMetadata& metadata,
                            Json record) const {
  write_exr(file(engine + ".exr"), image, metadata);
  if (standard_error.pixel_count() > 0) {
    record["standardError"] = error_file(engine);
    write_exr(file(error_file(engine)), standard_error, metadata);
  }
  record["bytes"] = size_of(file(engine + ".exr"));
  write_record(file(engine + ".json"), record);
}

std::string error_file(const std::string& engine) { return engine + "-error.exr"; }

double brightest(const Image& image) {
  double peak = 0;
  for (const float value : image.values())
    if (std::isfinite(value)) peak = std::max(peak, double(value));
  return peak;
}

double cell_exposure(const Image& ours) {
  return std::clamp(exposure_for_peak(brightest(ours)), -kMaxExposureStops, kMaxExposureStops);
}

}  // namespace lobelia
