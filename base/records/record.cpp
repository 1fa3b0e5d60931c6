#include "base/records/record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/system/error.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"

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

namespace {

/// Changes the texts of a record, and remembers whether any has changed.
class TextChanger {
 public:
  explicit TextChanger(const TextChange& change) : change_(change) {}

  /// False: the value is left out. Throws std::length_error if it is nested too deeply.
  bool apply(Json& value) {
    if (value.is_string()) return apply_to_text(value);
    if (!value.is_structured()) return true;
    if (depth_ == kMostDepth) throw std::length_error("");
    ++depth_;
    if (value.is_array())
      for (Json& element : value) apply(element);
    else
      apply_to_members(value);
    --depth_;
    return true;
  }
  bool has_changed() const { return has_changed_; }

 private:
  static constexpr int kMostDepth = 100;

  bool apply_to_text(Json& value) {
    const auto& text = value.get_ref<const std::string&>();
    const std::optional<std::string> now = change_(keys_, text);
    if (now && *now == text) return true;
    has_changed_ = true;
    if (now) value = *now;
    return now.has_value();
  }

  void apply_to_members(Json& object) {
    for (auto member = object.begin(); member != object.end();) {
      keys_.push_back(member.key());
      const bool is_kept = apply(member.value());
      keys_.pop_back();
      member = is_kept ? std::next(member) : object.erase(member);
    }
  }

  const TextChange& change_;
  std::vector<std::string> keys_;
  int depth_ = 0;
  bool has_changed_ = false;
};

}  // namespace

std::optional<std::string> with_texts(std::string_view record, const TextChange& change) try {
  Json json = Json::parse(record);
  const bool is_sealed = detail::origin_of(json, record).seal == Origin::Seal::kFits;
  TextChanger changer(change);
  changer.apply(json);
  if (!changer.has_changed()) return std::string(record);
  if (is_sealed) json[kSealKey] = seal_of(Json::parse(json.dump()));
  return detail::indented(json);
} catch (const Json::exception&) {
  return std::nullopt;
} catch (const std::length_error&) {
  return std::nullopt;
}

}  // namespace lobelia::records
