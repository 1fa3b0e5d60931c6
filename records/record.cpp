#include "records/record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/sha256.hpp"
#include "core/text.hpp"

namespace lobelia::records {

void require_kind(const Json& json, std::string_view kind, const Place& place) {
  const auto is = [&](const char* key, const Json& wanted) {
    const auto found = json.find(key);
    return found != json.end() && *found == wanted;
  };
  if (!is("kind", kind)) place.fail(fmt::format("not a record of kind '{}'", kind));
  if (!is("schemaVersion", kRecordSchemaVersion))
    place.fail(fmt::format("its schemaVersion is not {}", kRecordSchemaVersion));
}

std::string seal_of(Json record) {
  record.erase(kSealKey);
  return hex(sha256(record.dump()));
}

std::string json_number(double value) {
  return std::isfinite(value) ? Json(value).dump()
         : std::isnan(value)  ? "nan"
         : value > 0          ? "inf"
                              : "-inf";
}

bool is_json(std::string_view text) { return Json::accept(text); }

namespace detail {
namespace {

std::string at(const std::string& where) { return where.empty() ? "" : where + ": "; }

std::string indented(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Origin origin_of(const Json& json, std::string_view text) {
  Origin origin;
  if (!json.is_object()) return origin;
  if (const auto by = json.find("madeBy"); by != json.end() && by->is_string())
    origin.made_by = by->get<std::string>();
  if (const auto seal = json.find(kSealKey); seal != json.end())
    origin.seal = *seal == seal_of(json) && text == indented(json) ? Origin::Seal::kFits
                                                                   : Origin::Seal::kBroken;
  return origin;
}

Json sealed(const Struct& type, const void* record) {
  Json json = type.write(record);
  // Hash the record as a reader gets it, because some numbers are not read back unchanged.
  if (type.is_sealed()) json[kSealKey] = seal_of(Json::parse(json.dump()));
  return json;
}

}  // namespace

std::string text_of(const Struct& type, const void* record) {
  return indented(sealed(type, record));
}

std::string script_text_of(const Struct& type, const void* record) {
  return sealed(type, record).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void parse(const Struct& type, std::string_view text, const std::string& where, void* record,
           Origin* origin) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(ExitCode::kInput, at(where) + fmt::format("not a record: {}", error.what()));
  }
  if (origin) *origin = origin_of(json, text);
  try {
    type.read(json, {}, Place(), record);
    if (!type.is_sealed() || origin) return;
    const auto seal = json.find(kSealKey);
    if (seal == json.end()) Place().fail("has no hashes, being of an earlier version");
    if (*seal != seal_of(json)) Place().fail("has another content");
  } catch (const Error& error) {
    throw Error(error.code(), at(where) + error.what());
  }
}

}  // namespace detail
}  // namespace lobelia::records
