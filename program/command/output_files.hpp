// Keeps a command from writing over what it reads, and from writing two outputs to one place.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/system/files.hpp"

namespace lobelia::cli {

/// A report's file: to stdout, in place of the table.
inline constexpr std::string_view kStdout = "-";

class OutputFiles {
 public:
  /// A file that the command reads. May be missing. Throws Error(kInput) if the system cannot tell which file it is.
  void reads(const std::filesystem::path& file);
  /// Throws Error(kUsage) if the file is read, also through a link, or written already.
  void writes(const std::filesystem::path& file);
  /// writes() for a report. Does nothing if `path` is empty or kStdout. Throws Error(kOutput) if it cannot be written.
  void writes_report(const std::string& path);

 private:
  std::set<std::pair<dev_t, ino_t>> read_;
  std::set<std::filesystem::path> written_;
};

/// Lines of columns, each as wide as its widest cell. The first line is the head.
std::string aligned(const std::vector<std::vector<std::string>>& lines);

/// Paths and texts.
using Reports = std::initializer_list<std::pair<std::string, std::string>>;

/// Writes the reports to their files, all or none. Prints `table`, or in its place the report that goes to stdout.
void write_reports(std::string table, Reports reports);
/// Also commits the `files` that the command has written before.
void write_reports(std::string table, Reports reports, FilesTogether& files);

}  // namespace lobelia::cli
