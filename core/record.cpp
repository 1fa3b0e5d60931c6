#include "core/record.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "core/version.hpp"

namespace lobelia {
namespace {

constexpr std::uint64_t kMaxRecordBytes = 64u << 20;

/// nlohmann-json writes NaN and infinity as null, and no bytes that are no UTF-8: a file name, an engine's
/// output.
void make_writable(Json& value) {
  if (value.is_number_float())
    value = number_or_name(value.get<double>());
  else if (value.is_string())
    value = escape_invalid_utf8(value.get_ref<const std::string&>());
  else if (value.is_structured())
    for (auto& item : value) make_writable(item);
}

}  // namespace

Json make_record(const std::string& kind) {
  return {{"schemaVersion", kRecordSchemaVersion}, {"kind", kind}, {"madeBy", kNameAndVersion}};
}

std::string record_text(const Json& record) {
  Json writable = record;
  make_writable(writable);
  return writable.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_record(const std::filesystem::path& path, const Json& record, AtLink at_link) {
  write_file(path, record_text(record), at_link);
}

Json read_record(const std::filesystem::path& path, const std::string& kind) {
  Json record;
  try {
    record = Json::parse(read_file(path, kMaxRecordBytes));
  } catch (const Json::exception& error) {
    throw Error(ExitCode::kInput, fmt::format("{}: not a record: {}", path.string(), error.what()));
  }
  const auto is = [&](const char* key, const Json& wanted) {
    return record.is_object() && record.contains(key) && record[key] == wanted;
  };
  if (!is("kind", kind))
    throw Error(ExitCode::kInput,
                fmt::format("{}: not a record of kind '{}'", path.string(), kind));
  if (!is("schemaVersion", kRecordSchemaVersion))
    throw Error(ExitCode::kInput, fmt::format("{}: its schemaVersion is not {}", path.string(),
                                              kRecordSchemaVersion));
  return record;
}

Json number_or_name(double value) {
  if (std::isfinite(value)) return value;
  if (std::isnan(value)) return "nan";
  return value > 0 ? "inf" : "-inf";
}

Json to_json(Vec3 v) { return Json::array({v.x, v.y, v.z}); }
Json to_json(Rgb c) { return Json::array({c.r, c.g, c.b}); }

}  // namespace lobelia
