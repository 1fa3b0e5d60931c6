#include "cli/output_files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <optional>

#include "core/error.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// The same for all paths and links to a file.
std::optional<std::pair<dev_t, ino_t>> file_id(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

}  // namespace

void OutputFiles::reads(const fs::path& file) {
  if (const auto id = file_id(file)) read_.insert(*id);
}

void OutputFiles::writes(const fs::path& file) {
  std::error_code unknown;
  const auto id = file_id(file);
  if ((id && read_.contains(*id)) ||
      !written_.insert(fs::weakly_canonical(fs::absolute(file, unknown), unknown)).second)
    throw Error(ExitCode::kUsage,
                fmt::format("{}: is read or written by this command already", file.string()));
}

}  // namespace lobelia::cli
