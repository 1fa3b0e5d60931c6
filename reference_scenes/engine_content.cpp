#include "reference_scenes/content.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/process.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr char kTraceName[] = "loaded";
constexpr std::size_t kMostTraces = 500, kMostFiles = 5000;
constexpr std::uint64_t kMostTraceBytes = 32 << 20;
/// Lobelia's own programs between us and an engine are no part of it.
constexpr std::string_view kOurPrograms = "lobelia_";

/// The text after `what` in a line; empty if it is not there.
std::string_view text_after(std::string_view line, std::string_view what) {
  const auto at = line.find(what);
  return at == line.npos ? std::string_view() : line.substr(at + what.size());
}

/// Adds the files in the log of one process, which lists libraries and then the program that loaded them.
void add_files(const std::string& trace, EngineFiles& files) {
  std::vector<fs::path> libraries;
  for (const auto& line : split(trace, "\n")) {
    if (const auto library = text_after(line, "calling init: "); library.starts_with('/'))
      libraries.emplace_back(library);
    const auto program = text_after(line, "transferring control: ");
    if (program.empty()) continue;
    if (fs::path(program).filename().native().starts_with(kOurPrograms)) {
      libraries.clear();
      continue;
    }
    // The log has the name by which it was called.
    if (const fs::path found = find_program(std::string(program)); !found.empty())
      files.programs.push_back(found);
  }
  files.libraries.insert(files.libraries.end(), libraries.begin(), libraries.end());
}

void keep_each_once(std::vector<fs::path>& paths) {
  std::sort(paths.begin(), paths.end());
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  if (paths.size() > kMostFiles) paths.resize(kMostFiles);
}

}  // namespace

std::vector<std::string> LoaderTrace::environment() const {
  return {"LD_DEBUG=files", fmt::format("LD_DEBUG_OUTPUT={}", (directory_ / kTraceName).string())};
}

EngineFiles LoaderTrace::files() const {
  EngineFiles files;
  std::size_t traces = 0;
  std::error_code error;
  for (fs::directory_iterator entry(directory_, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& trace = entry->path();
    if (!trace.filename().native().starts_with(kTraceName) || ++traces > kMostTraces) continue;
    try {
      add_files(read_file(trace, kMostTraceBytes), files);
    } catch (const Error&) {
      // The program may have written something else there. But a trace lost to a fault would make another engine of it.
      if (!is_out_of_reach(trace, kMostTraceBytes)) throw;
    }
  }
  if (error && !tells_of_file(error.value()))
    throw failure_of(directory_.string() + ": cannot be listed", error.value(), ExitCode::kInput);
  keep_each_once(files.programs);
  keep_each_once(files.libraries);
  return files;
}

Content engine_content(const EngineStatus& status, FileHashes& hashes) {
  ContentReader reader(hashes);
  if (!status.program.empty()) reader.add("program", "", status.program);
  for (const auto& program : status.files.programs) reader.add("program", "", program);
  for (const auto& library : status.files.libraries)
    reader.add("library", library.filename().native(), library);
  for (const auto& data : status.files.data) {
    std::error_code unknown;
    if (fs::is_regular_file(data, unknown))
      reader.add("data", data.filename().native(), data);
    else
      reader.add_directory(data);
  }
  return reader.content();
}

}  // namespace lobelia
