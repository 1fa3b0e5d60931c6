// Records on disk, as JSON: what was made, by which program, how long it took, how good it is.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/records/struct_type.hpp"
#include "base/system/files.hpp"

namespace lobelia::records {

/// Version of the layout of all records (`schemaVersion`); raised when a key changes its meaning.
inline constexpr int kRecordSchemaVersion = 1;
inline constexpr char kSealKey[] = "seal";
/// Largest file that is accepted as a record.
inline constexpr std::uint64_t kMaxRecordBytes = 64u << 20;

/// Which program wrote a record, and whether it has changed since.
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

/// The record as in its file: indented, with a final newline, sealed if its kind is. Bytes that are not UTF-8 become \xNN.
template <class T>
std::string record_text(const T& record) {
  return detail::text_of(struct_type<T>(), &record);
}

/// The record in one line, for a page's script.
template <class T>
std::string record_line(const T& record) {
  return detail::script_text_of(struct_type<T>(), &record);
}

/// Replaces the file in one step.
template <class T>
void write_record(const std::filesystem::path& path, const T& record,
                  AtLink at_link = AtLink::kFollow) {
  write_file(path, record_text(record), at_link);
}

/// Reads every key of the table. Other keys are ignored, because they may be added within a schemaVersion. Throws
/// Error(kInput), such as "cell.json: images[2].sha256: missing", if the text is not JSON or has another kind or
/// schemaVersion; if a key is missing, has another type or is out of bounds; if the record contradicts itself; or if its
/// seal does not fit.
///
/// With `origin`, a missing or broken seal is not an error but reported there, even if a key throws. Any byte that
/// record_text() would not write then breaks the seal, too.
template <class T>
T parse_record(std::string_view text, const std::string& where, Origin* origin = nullptr) {
  T record;
  detail::parse(struct_type<T>(), text, where, &record, origin);
  return record;
}

template <class T>
T read_record(const std::filesystem::path& path, Origin* origin = nullptr) {
  return parse_record<T>(read_file(path, kMaxRecordBytes), path.string(), origin);
}

/// A number as in records: "0.1", "16.0", "nan".
std::string json_number(double value);

/// Whether a text is valid JSON.
bool is_json(std::string_view text);

/// Throws Error(kInput) unless `json` has this kind and a schemaVersion that this program reads.
void require_kind(const Json& json, std::string_view kind, const Place& place);

/// The SHA-256 of the record without its seal. It reveals changes of the record, as the hashes in it reveal changes of
/// files.
std::string seal_of(Json record);

/// The new text for these keys of a record, which do not count places in lists; if empty, the text is left out.
using TextChange = std::function<std::optional<std::string>(std::span<const std::string> keys,
                                                            const std::string& text)>;

/// The record with changed texts, sealed again if its seal fitted. The same bytes if no text changes, nothing if it is no
/// JSON.
std::optional<std::string> with_texts(std::string_view record, const TextChange& change);

}  // namespace lobelia::records
