// Records: what was made, by what, how long it took, how good it is. JSON, one per result.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/files.hpp"
#include "core/vec.hpp"

namespace lobelia {

/// Keys stay in the order they were written, so that a person can read a record from the top.
using Json = nlohmann::ordered_json;

/// Version of every record's layout ("schemaVersion"); raised when a key changes its meaning.
inline constexpr int kRecordSchemaVersion = 1;

/// {"schemaVersion": 1, "kind": kind, "madeBy": "lobelia 0.1.0"}, to be filled further.
Json make_record(const std::string& kind);

/// Writes atomically, indented, with a final newline. NaN and infinity become strings, because
/// JSON has none and null would hide which it was; bytes that are no UTF-8 become \xNN.
void write_record(const std::filesystem::path& path, const Json& record,
                  AtLink at_link = AtLink::kFollow);
std::string record_text(const Json& record);

/// Throws Error(kInput) if it is missing, broken, of another kind or of another schemaVersion.
Json read_record(const std::filesystem::path& path, const std::string& kind);

/// A finite number as itself, otherwise "nan", "inf" or "-inf".
Json number_or_name(double value);

Json to_json(Vec3 v);
Json to_json(Rgb c);

}  // namespace lobelia
