// Records as JSON, for tests that look at their keys or spoil them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "base/records/record.hpp"
#include "base/system/files.hpp"

namespace lobelia {

using records::Json;

template <class T>
Json as_json(const T& record) {
  return Json::parse(records::record_text(record));
}

inline Json read_json(const std::filesystem::path& path) {
  return Json::parse(read_file(path, records::kMaxRecordBytes));
}

inline void write_json(const std::filesystem::path& path, const Json& json) {
  write_file(path, json.dump(2) + "\n");
}

/// With the right hash in its `seal`.
inline Json sealed(Json json) {
  json[records::kSealKey] = records::seal_of(json);
  return json;
}

}  // namespace lobelia
