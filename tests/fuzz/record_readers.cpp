#include <array>

#include "base/system/removal.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "farm/result_cache.hpp"
#include "gallery/cells/checked_cell.hpp"
#include "tests/fuzz/bundle.hpp"
#include "tests/fuzz/checks.hpp"
#include "tests/json.hpp"

namespace lobelia::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFarmCells = 3;

/// The record with a valid seal, and the hashes of the files in `directory` that it names; unchanged if it is no record.
std::string sealed(const std::string& text, const fs::path& directory, const char* key) {
  Json record = Json::parse(text, nullptr, false);
  if (!record.is_object()) return text;
  if (key) record["key"] = key;
  if (auto files = record.find("files"); files != record.end() && files->is_array())
    for (Json& file : *files) {
      if (!file.is_object() || !file.contains("name") || !file["name"].is_string()) continue;
      const std::string name = file["name"];
      std::error_code error;
      if (!is_plain_name(name) || name.find('\0') != name.npos) continue;
      const auto size = fs::file_size(directory / name, error);
      if (error) continue;
      file["bytes"] = std::uint64_t(size);
      file["sha256"] = hex(sha256_of_file(directory / name));
    }
  try {
    record["seal"] = records::seal_of(record);
    return record.dump();
  } catch (const Json::exception&) {  // bytes that are no UTF-8
    return text;
  }
}

void check_gallery(const std::map<std::string, std::string>& files, bool seal) {
  static const fs::path run = scratch() / "run";
  remove_in_temporary_directory(run);
  fs::create_directories(run);
  if (const auto farm = files.find("farm.json"); farm != files.end())
    write_plainly(run / "farm.json", farm->second);
  gallery::ShownFarm farm;
  try {
    farm = gallery::read_farm(run);
  } catch (const Error& error) {
    check_refusal(error);
    return;
  }
  if (farm.record.axes.empty()) throw std::logic_error("a farm without axes");
  for (std::size_t i = 0; i < std::min(farm.cells.size(), kMostFarmCells); ++i) {
    const fs::path directory = run / "cells" / farm.cells[i].id;
    if (directory.parent_path() != run / "cells")
      throw std::logic_error("a cell's id is no name: " + farm.cells[i].id);
    fs::create_directories(directory);
    for (const auto& [name, text] : files)
      if (name != "cell.json") write_plainly(directory / name, text);
    if (const auto cell = files.find("cell.json"); cell != files.end())
      write_plainly(directory / "cell.json",
                    seal ? sealed(cell->second, directory, nullptr) : cell->second);
    const gallery::CheckedCell data =
        gallery::check_cell(run, farm.cells[i], farm.metrics, farm.hub);
    for (const std::string& name : files_of(data))
      if (!is_plain_name(name)) throw std::logic_error("a cell shows the file " + name);
  }
}

void check_cache(const std::map<std::string, std::string>& files, bool seal) {
  static const ResultCache cache(scratch() / "cache");
  static const ResultKey key = result_key({"fuzz"});
  const auto record = files.find(kManifestFile);
  if (record == files.end()) return;
  const fs::path directory = cache.result_directory(key);
  remove_in_temporary_directory(directory);
  fs::create_directories(directory);
  for (const auto& [name, text] : files)
    if (name != kManifestFile) write_plainly(directory / name, text);
  write_plainly(directory / kManifestFile,
                seal ? sealed(record->second, directory, key.text().c_str()) : record->second);
  for (const auto look : {ResultCache::Look::kQuick, ResultCache::Look::kThorough}) {
    std::string why_not;
    const auto found = cache.find(key, look, &why_not);
    if (found.has_value() != why_not.empty())
      throw std::logic_error("a result is refused without a word, or accepted with one");
    if (found && found->key != key.text()) throw std::logic_error("a result of another key");
  }
}

}  // namespace

void check_record_readers(std::string_view bundle) {
  const auto files = files_of_bundle(bundle);
  for (const bool seal : {false, true}) {
    check_gallery(files, seal);
    check_cache(files, seal);
  }
}

}  // namespace lobelia::fuzz
