#include "program/command/output_files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <optional>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/no_resources.hpp"
#include "program/command/messages.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// The same for all paths and links to a file. Nothing if there is none, or if it cannot be reached. Throws Error(kInput)
/// where the system cannot tell, because a file that is read could then be written over.
std::optional<std::pair<dev_t, ino_t>> file_id(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return std::pair(status.st_dev, status.st_ino);
  if (!tells_of_file(errno))
    throw failure_of(path.string() + ": cannot read", errno, ExitCode::kInput);
  return std::nullopt;
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
    throw Error(ExitCode::kUsage, "{}: is read or written by this command already", file.string());
}

void OutputFiles::writes_report(const std::string& path) {
  if (path.empty() || path == kStdout) return;
  writes(path);
  require_writable(path);
}

std::string aligned(const std::vector<std::vector<std::string>>& lines) {
  constexpr std::size_t kGap = 2;
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
  std::string text;
  for (const auto& line : lines) {
    std::string one;
    for (std::size_t k = 0; k < line.size(); ++k)
      one += fmt::format("{:<{}}", line[k], widths[k] + kGap);
    text += one.substr(0, one.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

void write_reports(std::string table, Reports reports) {
  FilesTogether files;
  write_reports(std::move(table), reports, files);
}

void write_reports(std::string table, Reports reports, FilesTogether& files) {
  table = with_colours(table);
  for (const auto& [path, text] : reports)
    if (path == kStdout)
      table = text;
    else if (!path.empty())
      write_file(path, text);
  files.commit();
  fmt::print("{}", table);
}

}  // namespace lobelia::cli
