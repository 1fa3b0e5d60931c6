// What a published site does not tell of the machine that made it: paths, names of hosts and users, process IDs.
#pragma once

#include <map>
#include <memory>

#include "records/farm.hpp"
#include "records/record.hpp"

namespace lobelia::gallery {

class Scrub {
 public:
  /// `directories`: known ones, which may have spaces in their names; `hosts`, `users`: names beside this machine's.
  explicit Scrub(const std::vector<std::filesystem::path>& directories,
                 const std::vector<std::string>& hosts = {},
                 const std::vector<std::string>& users = {});

  /// Values on the axes of a grid that are paths become different texts, as they were.
  void keep_apart(const std::vector<records::Axis>& axes);

  /// Every absolute path becomes its last part. URLs stay.
  std::string without_paths(std::string_view text) const;
  /// Of an engine's output: also without names of hosts and users, and process IDs.
  std::string log(std::string_view text) const;
  /// A record, its seal made anew; no record as log().
  std::string record(std::string_view text) const;
  /// The file as it is published; nothing if it is to be copied as it is. A cell's record has the hashes of its published
  /// files. Throws Error(kInput) if it cannot be read.
  std::optional<std::string> file(const std::filesystem::path& path) const;

 private:
  std::optional<std::string> text_of_record(std::span<const std::string> keys,
                                            const std::string& text) const;
  /// The length of the longest known directory that `text` begins with; 0 if it is none.
  std::size_t known_directory(std::string_view text) const;
  std::string without_names(std::string_view text, bool only_telling) const;
  std::string cell(std::string text, const std::filesystem::path& directory) const;

  std::vector<std::string> directories_;  ///< the longest first
  std::vector<std::string> hosts_, users_, homes_;
  std::map<std::string, std::string> values_;  ///< of axes
};

/// The directory of a run, and what is taken out of its records when they are read; null: nothing.
struct RunFiles {
  RunFiles(std::filesystem::path run, const Scrub* scrubbed = nullptr)  // NOLINT: a path is one
      : directory(std::move(run)), scrub(scrubbed) {}
  operator const std::filesystem::path&() const { return directory; }  // NOLINT: it is one
  std::filesystem::path operator/(const std::string& name) const { return directory / name; }

  std::filesystem::path directory;
  const Scrub* scrub;
};

/// records::read_record() without what `scrub` takes out; it may be null. Errors name the file by `where`.
template <class T>
T read_scrubbed(const std::filesystem::path& path, const Scrub* scrub, const std::string& where,
                records::Origin* origin = nullptr) {
  const std::string text = read_file(path, records::kMaxRecordBytes);
  return records::parse_record<T>(scrub ? scrub->record(text) : text, where, origin);
}

}  // namespace lobelia::gallery
