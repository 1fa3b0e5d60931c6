#include "farm/chunk_report.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/host.hpp"
#include "core/removal.hpp"
#include "core/text.hpp"
#include "farm/slurm/slurm_answers.hpp"
#include "records/record.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr char kDirectory[] = "reports";
constexpr std::size_t kMostReportBytes = 64 << 10;
constexpr std::size_t kMostLeft = 100;      // far more than there are engines
constexpr std::size_t kMostWhy = 500;       // bytes
constexpr std::size_t kMostProblems = 10;   // are told
constexpr std::size_t kMostReports = 2000;  // two rounds of as many elements as there can be

/// "7.json": 7
std::optional<std::size_t> number_of(std::string_view name) {
  constexpr std::string_view kEnding = ".json";
  if (!name.ends_with(kEnding)) return {};
  name.remove_suffix(kEnding.size());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size() || std::to_string(number) != name)
    return {};
  return number;
}

bool is_engine_name(std::string_view name) {
  return name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
         });
}

std::string why_not_read(const HeldDirectory& directory, const std::string& name) {
  struct stat status {};
  if (::fstatat(directory.fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
    return std::strerror(errno);
  if (S_ISLNK(status.st_mode)) return "a link";
  if (!S_ISREG(status.st_mode)) return "not a regular file";
  return std::uint64_t(status.st_size) > kMostReportBytes
             ? fmt::format("over {} bytes", kMostReportBytes)
             : "it cannot be read";
}

ChunkReport parse_report(const std::string& text, std::size_t number) {
  auto record = records::parse_record<records::FarmChunkReport>(text, "");
  if (!is_node_name(record.node))
    throw Error(ExitCode::kInput, fmt::format("'{}' is no name of a node", printable(record.node)));
  for (LeftUndone& left : record.left) {
    if (!is_engine_name(left.engine))
      throw Error(ExitCode::kInput,
                  fmt::format("'{}' is no name of an engine", printable(left.engine)));
    left.why = printable(left.why, kMostWhy);
  }
  return {number, std::move(record.node), std::move(record.left)};
}

}  // namespace

std::string own_node_name() {
  const char* given = std::getenv("SLURMD_NODENAME");
  return given && is_node_name(given) ? given : host_name();
}

void write_chunk_report(const fs::path& run_directory, std::size_t number,
                        std::span<const LeftUndone> left) {
  if (left.empty()) return;
  const fs::path directory = run_directory / kDirectory;
  const fs::path path = directory / fmt::format("{}.json", number);
  const std::string node = own_node_name();
  if (!is_node_name(node))
    throw Error(ExitCode::kOutput, fmt::format("{}: '{}' is no name of a node",
                                               printable_path(path.string()), printable(node)));
  make_directories(directory);
  for (const fs::path& one : {directory, path}) {
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(one, ignored)))
      throw Error(ExitCode::kOutput, fmt::format("{}: a link; a report is not written through it",
                                                 printable_path(one.string())));
  }
  records::FarmChunkReport record;
  record.node = node;
  for (const LeftUndone& one : left.first(std::min(left.size(), kMostLeft)))
    record.left.push_back({one.engine, printable(one.why, kMostWhy)});
  records::write_record(path, record, AtLink::kReplace);
}

ChunkReports read_chunk_reports(const fs::path& run_directory, std::size_t first, std::size_t end) {
  ChunkReports found;
  const fs::path path = run_directory / kDirectory;
  const auto problem = [&](const fs::path& where, std::string_view what) {
    if (found.problems.size() < kMostProblems)
      found.problems.push_back(
          fmt::format("{}: not taken for a report: {}", printable_path(where.string()), what));
  };
  const HeldDirectory directory = HeldDirectory(run_directory).below(kDirectory);
  if (!directory && !directory.is_missing()) problem(path, directory.why_not());
  std::vector<std::size_t> numbers;
  for (const std::string& name : directory.names())
    if (const auto number = number_of(name); number && *number >= first && *number < end)
      numbers.push_back(*number);
  std::sort(numbers.begin(), numbers.end());
  if (numbers.size() > kMostReports) {
    problem(path, fmt::format("only the last {} of {} are read", kMostReports, numbers.size()));
    numbers.erase(numbers.begin(), numbers.end() - kMostReports);
  }
  for (const std::size_t number : numbers) {
    const std::string name = fmt::format("{}.json", number);
    try {
      const auto text = directory.read(name, kMostReportBytes);
      if (text)
        found.reports.push_back(parse_report(*text, number));
      else
        problem(path / name, why_not_read(directory, name));
    } catch (const Error& error) {
      problem(path / name, error.what());
    }
  }
  return found;
}

}  // namespace lobelia
