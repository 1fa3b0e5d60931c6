// Keeps a published site from telling of the machine that made it: paths, names of hosts and users, process IDs. A text that
// could tell one is left out whole; paths and commands are published as the names of their files.
#pragma once

#include <map>
#include <memory>

#include "base/records/farm.hpp"
#include "base/records/record.hpp"

namespace lobelia::gallery {

/// In place of a text or a line that tells of the machine.
inline constexpr char kLeftOut[] = "(left out: it tells of the machine)";

/// The text with the name of the file in place of each absolute path, which may be in quotes. A path of two names, such as
/// somebody's home, becomes "…".
std::string without_paths(std::string_view text);

/// Whether a text may have an absolute path, a home directory or the address of a machine in it. URLs of the web are none.
bool tells_path(const std::string& text);

class PublishedTexts {
 public:
  /// `hosts`, `users`: names beside this machine's and this user's.
  explicit PublishedTexts(std::vector<std::string> hosts = {}, std::vector<std::string> users = {});

  /// Values on the axes of a grid that are paths become different texts, as they were.
  void keep_apart(const std::vector<records::Axis>& axes);

  /// A record, its seal made anew; no record as lines().
  std::string record(std::string_view text) const;
  /// Without the lines that tell a path or, `of_log`, a name or a process ID.
  std::string lines(std::string_view text, bool of_log = true) const;
  /// The file as it is published; nothing if it is to be copied as it is. A cell's record has the hashes of its published
  /// files. Throws Error(kInput) if it cannot be read.
  std::optional<std::string> file(const std::filesystem::path& path) const;

 private:
  std::optional<std::string> text_of_record(std::span<const std::string> keys,
                                            const std::string& text) const;
  bool tells_name(const std::string& text) const;
  std::string cell(std::string text, const std::filesystem::path& directory) const;

  std::vector<std::string> names_;             ///< of hosts and users
  std::map<std::string, std::string> values_;  ///< of axes
};

/// The directory of a run, and how its texts are published; null: as they are.
struct RunFiles {
  RunFiles(std::filesystem::path run, const PublishedTexts* published = nullptr)  // NOLINT: a path
      : directory(std::move(run)), texts(published) {}
  operator const std::filesystem::path&() const { return directory; }  // NOLINT: it is one
  std::filesystem::path operator/(const std::string& name) const { return directory / name; }

  std::filesystem::path directory;
  const PublishedTexts* texts;
};

/// records::read_record() with its texts as they are published; `texts` may be null. Errors name the file by `where`.
template <class T>
T read_published(const std::filesystem::path& path, const PublishedTexts* texts,
                 const std::string& where, records::Origin* origin = nullptr) {
  const std::string text = read_file(path, records::kMaxRecordBytes);
  return records::parse_record<T>(texts ? texts->record(text) : text, where, origin);
}

}  // namespace lobelia::gallery
