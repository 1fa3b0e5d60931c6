// Records on disk: what was made, by what, how long it took, how good it is. JSON, one per result.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/files.hpp"
#include "records/struct_type.hpp"

namespace lobelia::records {

/// Version of every record's layout (`schemaVersion`); raised when a key changes its meaning.
inline constexpr int kRecordSchemaVersion = 1;
inline constexpr char kSealKey[] = "seal";
/// Largest file that is read as a record.
inline constexpr std::uint64_t kMaxRecordBytes = 64u << 20;

/// Who wrote a record, and whether it still is what they wrote.
struct Origin {
  enum class Seal : std::uint8_t { kNone, kFits, kBroken };
  std::string made_by;  ///< program and version
  Seal seal = Seal::kNone;
};

namespace detail {
std::string text_of(const Struct& type, const void* record);
std::string script_text_of(const Struct& type, const void* record);
void parse(const Struct& type, std::string_view text, const std::string& where, void* record,
           Origin* origin);
}  // namespace detail

/// The record as its file has it: indented, with a final newline, sealed if its kind is. Bytes that are no UTF-8
/// become \xNN.
template <class T>
std::string record_text(const T& record) {
  return detail::text_of(T::type(), &record);
}

/// The record in one line, for a page's script.
template <class T>
std::string record_line(const T& record) {
  return detail::script_text_of(T::type(), &record);
}

/// Writes it at once.
template <class T>
void write_record(const std::filesystem::path& path, const T& record,
                  AtLink at_link = AtLink::kFollow) {
  write_file(path, record_text(record), at_link);
}

/// Reads every key that its table has. Throws Error(kInput): "cell.json: images[2].sha256: missing" where the text is no
/// JSON, of another kind or schemaVersion, where a key is missing, has another type or is out of bounds, where the
/// record contradicts itself, or where its seal does not fit. Keys that the table does not have are passed over: they
/// may be added within a schemaVersion.
///
/// With `origin` a seal that is missing or broken is no error: it is told there, also where a key throws. There any byte
/// that record_text() would not write breaks a seal too.
template <class T>
T parse_record(std::string_view text, const std::string& where, Origin* origin = nullptr) {
  T record;
  detail::parse(T::type(), text, where, &record, origin);
  return record;
}

template <class T>
T read_record(const std::filesystem::path& path, Origin* origin = nullptr) {
  return parse_record<T>(read_file(path, kMaxRecordBytes), path.string(), origin);
}

/// A number as records have it: "0.1", "16.0", "nan".
std::string json_number(double value);

/// Whether a text is JSON, of any content.
bool is_json(std::string_view text);

/// Throws Error(kInput) unless `json` has that kind and a schemaVersion that this program reads.
void require_kind(const Json& json, std::string_view kind, const Place& place);

/// The SHA-256 by which a change of a record itself shows, as that of its files shows by the hashes in it: of the
/// record without its seal.
std::string seal_of(Json record);

}  // namespace lobelia::records
