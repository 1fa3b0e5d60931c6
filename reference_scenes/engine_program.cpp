#include "reference_scenes/engine_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <limits>
#include <thread>

#include "core/contained_reader.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/numbers.hpp"
#include "core/removal.hpp"
#include "core/text.hpp"
#include "reference_scenes/engine_content.hpp"

namespace lobelia {
namespace {

constexpr double kProbeSeconds = 60;  // a cold disk under Blender may take ten
constexpr std::size_t kMaxWords = 300;
constexpr std::uint64_t kSmallPicture = 1 << 20;     // pixels
constexpr int kSignalBase = 128, kMostSignals = 64;  // beyond, it is an exit code of its own: 255

/// "3.7.0.10" out of "POV-Ray 3.7.0.10.unofficial".
std::string version_after(std::string_view line, std::string_view prefix) {
  if (!line.starts_with(prefix)) return {};
  line.remove_prefix(prefix.size());
  std::size_t length = 0;
  while (length < line.size() &&
         (std::isdigit(static_cast<unsigned char>(line[length])) || line[length] == '.'))
    ++length;
  std::string version(line.substr(0, length));
  while (version.ends_with('.')) version.pop_back();
  return version;
}

bool is_supported(const std::string& version, const EngineProbe& probe) {
  const auto parts = split(version, ".");
  long long major = 0, minor = 0;
  return parts.size() >= 2 && parse_integer(parts[0], major) && parse_integer(parts[1], minor) &&
         probe.supports(int(major), int(minor));
}

}  // namespace

EngineStatus probe_engine(const EngineInfo& engine, const EngineProbe& probe,
                          const std::filesystem::path& program) {
  EngineStatus status;
  const std::string wanted = program.empty() ? std::string(probe.program) : program.string();
  status.program = find_program(wanted);
  if (status.program.empty()) {
    std::error_code ignored;
    // In $PATH what cannot be executed is passed over, as a shell does.
    if (!program.empty() && std::filesystem::exists(program, ignored))
      status.state = EngineState::kBroken;
    status.why = program.empty() ? fmt::format("no program '{}' in $PATH", probe.program)
                                 : fmt::format("'{}' is not a program", printable(wanted, 400));
    return status;
  }
  status.state = EngineState::kBroken;
  const TemporaryDirectory home;
  const LoaderTrace trace(home.path());
  ProcessOptions options;
  options.timeout = std::chrono::duration<double>(kProbeSeconds);
  options.environment = engine_environment(home.path());
  options.only_environment = true;
  for (auto& variable : trace.environment()) options.environment.push_back(std::move(variable));
  // POV-Ray prints its version on stderr, after complaints about missing configuration files.
  options.on_line = [&](std::string_view line) {
    if (status.version.empty()) status.version = version_after(line, probe.version_prefix);
  };
  ProcessResult result;
  try {
    result = run_process({status.program.string(), "--version"}, options);
    // An engine that was killed here would be left out of all that follows.
    if (status.version.empty() && result.exit_code > kSignalBase && !result.timed_out &&
        !result.interrupted)
      result = run_process({status.program.string(), "--version"}, options);
  } catch (const Error& error) {
    status.why = error.what();
    return status;
  }
  if (result.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  if (result.timed_out)
    status.why = fmt::format("'{}' did not tell its version within {} s", status.program.string(),
                             kProbeSeconds);
  else if (result.exit_code != 0)
    status.why = fmt::format(
        "'{}' --version ended with {} {}", status.program.string(),
        result.exit_code > kSignalBase ? "signal" : "exit code",
        result.exit_code > kSignalBase ? result.exit_code - kSignalBase : result.exit_code);
  else if (status.version.empty())
    status.why = fmt::format("'{}' does not answer --version as {} does", status.program.string(),
                             engine.title);
  else if (!is_supported(status.version, probe))
    status.why = fmt::format("'{}' is {} {}; what can be driven is {}", status.program.string(),
                             engine.title, status.version, engine.supported_versions);
  else
    status.state = EngineState::kReady;
  if (!status.available()) return status;
  status.files = trace.files();
  if (probe.directories) {
    std::vector<std::filesystem::path> programs = status.files.programs;
    programs.push_back(status.program);
    for (const auto& one : programs)
      for (auto& directory : probe.directories(one, status.version))
        status.files.directories.push_back(std::move(directory));
  }
  return status;
}

void require_available(const EngineInfo& engine, const EngineStatus& status) {
  if (!status.available())
    throw Error(ExitCode::kEngine,
                fmt::format("{} is {}: {}; to install it: {}", engine.title,
                            status.state == EngineState::kBroken ? "broken" : "not available",
                            status.why, engine.install_hint));
}

std::vector<std::string> engine_environment(const std::filesystem::path& directory) {
  std::vector<std::string> environment{"LC_ALL=C.UTF-8", "TZ=UTC"};
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "TMPDIR", "TMP", "TEMP"})
    environment.push_back(fmt::format("{}={}", name, directory.string()));
  for (const char* name : kPassedOn)
    if (const char* value = std::getenv(name))
      environment.push_back(fmt::format("{}={}", name, value));
  return environment;
}

std::string last_words(const std::string& output_tail) {
  auto lines = split(output_tail, "\n");
  // Progress explains nothing: our script's messages and Cycles' frames.
  std::erase_if(lines, [](const std::string& line) {
    return line.starts_with("lobelia: ") || line.starts_with("Fra:");
  });
  // The lines after the first error explain it. Without an error, take the last lines.
  std::size_t first = lines.size() - std::min<std::size_t>(lines.size(), 3);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].find("Error") != std::string::npos ||
        lines[i].find("error") != std::string::npos) {
      first = i;
      break;
    }
  std::string words;
  for (std::size_t i = first; i < lines.size() && words.size() < kMaxWords; ++i)
    words += (words.empty() ? "" : " ") + lines[i];
  return printable(words, kMaxWords);
}

Failure process_failure(const EngineInfo& engine, const ProcessResult& result,
                        const ReferenceOptions& options) {
  if (result.timed_out)
    return {FailureClass::kTimedOut,
            fmt::format("{} was stopped after {:.6g} s, the time limit of a picture", engine.title,
                        options.time_limit.count())};
  if (result.no_progress)
    return {FailureClass::kNoProgress,
            fmt::format("{} was stopped after {:.6g} s without a sign of progress", engine.title,
                        options.no_progress_limit.count())};
  if (result.over_disk_limit)
    return {FailureClass::kDiskLimit,
            fmt::format("{} was stopped because its files came to {}; allowed: {}", engine.title,
                        result.used_bytes > 0 ? size_text(result.used_bytes) : "more",
                        size_text(options.disk_limit))};
  if (result.out_of_memory && result.used_bytes > 0)
    return {FailureClass::kOutOfMemory,
            fmt::format("{} was stopped because it used {} of memory; allowed: {}", engine.title,
                        size_text(result.used_bytes), size_text(options.memory_limit))};
  if (result.out_of_memory)
    return {FailureClass::kOutOfMemory,
            fmt::format("{} was killed by the kernel when there was no memory left; allowed: {}, "
                        "and it had at most {}",
                        engine.title,
                        options.memory_limit > 0 ? size_text(options.memory_limit) : "any amount",
                        size_text(result.peak_memory_bytes))};
  if (result.exit_code == 0) return {};
  const std::string words = last_words(result.output_tail);
  const int signal = result.exit_code - kSignalBase;
  const bool crashed = signal > 0 && signal <= kMostSignals;
  const std::string how = crashed ? fmt::format("was ended by signal {}", signal)
                                  : fmt::format("stopped with exit code {}", result.exit_code);
  return {crashed ? FailureClass::kCrash : FailureClass::kExitCode,
          fmt::format("{} {}{}{}", engine.title, how, words.empty() ? "" : ": ", words)};
}

Failure run_engine(const EngineInfo& engine, const std::vector<std::string>& arguments,
                   ProcessOptions process, const ReferenceOptions& options, ProcessResult& result) {
  bool started = false;
  process.only_environment = true;
  process.memory_limit = options.memory_limit;
  process.disk_limit = options.disk_limit;
  process.on_start = [&started, told = std::move(process.on_start)](const ProcessLimits& limits) {
    started = true;
    if (told) told(limits);
  };
  try {
    result = run_process(arguments, process);
  } catch (const Error& error) {
    if (started) throw;  // by whoever listens to it
    return {find_program(arguments.front()).empty() ? FailureClass::kEngineMissing
                                                    : FailureClass::kCrash,
            error.what()};
  }
  if (result.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  Failure failure = process_failure(engine, result, options);
  // It is gone when anybody reads this.
  const std::string directory = process.working_directory.string();
  for (std::size_t at;
       !directory.empty() && (at = failure.message.find(directory)) != std::string::npos;)
    failure.message.replace(at, directory.size(), kEngineDirectory);
  return failure;
}

Failure read_engine_picture(const EngineInfo& engine, const std::filesystem::path& file,
                            const Film& film, Image& image) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    return {FailureClass::kNoOutput, fmt::format("{} wrote no picture", engine.title)};
  try {
    // Room for one of another size, so that the message can say which.
    const std::uint64_t pixels = 4 * std::uint64_t(film.width) * std::uint64_t(film.height);
    image = read_picture(file, "", {std::max(pixels, kSmallPicture), 0}).image;
  } catch (const std::exception& error) {
    throw_if_interrupted();
    return {FailureClass::kBadOutput,
            fmt::format("{}'s picture cannot be used: {}", engine.title, error.what())};
  }
  if (image.width() != film.width || image.height() != film.height)
    return {FailureClass::kWrongSize,
            fmt::format("{}'s picture has another size than was asked for: {} x {}, not {} x {}",
                        engine.title, image.width(), image.height(), film.width, film.height)};
  return {};
}

ReferenceResult failed_result(const EngineInfo& engine, const EngineStatus& status,
                              const Scene& scene, const Failure& failure) {
  ReferenceResult result;
  result.error = failure.message;
  result.failure = failure.kind;
  result.begun = std::chrono::steady_clock::now();
  result.record = reference_record(engine, status, scene);
  return result;
}

int threads_of(const ReferenceOptions& options) {
  return options.threads > 0 ? options.threads
                             : int(std::max(1u, std::thread::hardware_concurrency()));
}

ProcessLimits weaker(const ProcessLimits& a, const ProcessLimits& b) {
  return {a.writes_limited && b.writes_limited, std::min(a.contained, b.contained)};
}

void record_limits(records::Reference& record, const ProcessLimits& limits) {
  record.writes_limited = limits.writes_limited;
  record.contained = containment_name(limits.contained);
}

void record_cost(records::Reference& record, double cpu_seconds, std::uint64_t peak_memory_bytes,
                 int threads) {
  record.cpu_seconds = cpu_seconds;
  record.peak_memory_bytes = peak_memory_bytes;
  record.threads = threads;
}

records::Reference reference_record(const EngineInfo& engine, const EngineStatus& status,
                                    const Scene& scene) {
  records::Reference record;
  record.engine = {std::string(engine.name), std::string(engine.title), status.version};
  record.image = {"", scene.film.width, scene.film.height};
  return record;
}

}  // namespace lobelia
