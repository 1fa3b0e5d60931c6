// Keeps a command from writing over what it reads, and from writing two outputs to one place.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

namespace lobelia::cli {

/// A report's file: to stdout, in place of the table.
inline constexpr std::string_view kStdout = "-";

class OutputFiles {
 public:
  /// A file that the command reads. May be missing.
  void reads(const std::filesystem::path& file);
  /// Throws Error(kUsage) if the file is read, also through a link, or written already.
  void writes(const std::filesystem::path& file);

 private:
  std::set<std::pair<dev_t, ino_t>> read_;
  std::set<std::filesystem::path> written_;
};

}  // namespace lobelia::cli
