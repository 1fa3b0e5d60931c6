#include "reference_scenes/engine_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>
#include <thread>

#include "base/pictures/contained_reader.hpp"
#include "base/pictures/image_io_module.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/removal.hpp"
#include "base/words/numbers.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/content.hpp"
#include "renderer/render_record.hpp"

namespace lobelia {
namespace {

constexpr int kNotInstalled =
    69;  // exit code EX_UNAVAILABLE of our own programs: what they drive is not there
constexpr double kProbeSeconds = 60;  // a cold disk under Blender may take ten
constexpr std::size_t kMaxWords = 300;
constexpr std::uint64_t kSmallPicture = 1 << 20;     // pixels
constexpr int kSignalBase = 128, kMostSignals = 64;  // above both it is an exit code: 255

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

/// Runs the program with --version and fills in its version and files. Returns why it is not ready.
std::string why_not_ready(const EngineInfo& engine, const EngineProbe& probe,
                          EngineStatus& status) {
  const TemporaryDirectory home;
  const LoaderTrace trace(home.path());
  ProcessOptions options;
  options.timeout = std::chrono::duration<double>(kProbeSeconds);
  options.environment = engine_environment(home.path());
  options.only_environment = true;
  std::ranges::copy(trace.environment(), std::back_inserter(options.environment));
  // POV-Ray prints its version on stderr, after complaints about missing configuration files.
  options.on_line = [&](std::string_view line) {
    if (status.version.empty()) status.version = version_after(line, probe.version_prefix);
  };
  const std::string name = status.program.string();
  ProcessResult result;
  try {
    result = run_process({name, "--version"}, options);
    // Once more if it was killed: otherwise it would be missing from the whole run.
    if (status.version.empty() && result.exit_code > kSignalBase && !result.timed_out &&
        !result.interrupted)
      result = run_process({name, "--version"}, options);
  } catch (const Error& error) {
    return error.what();
  }
  if (result.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  if (result.timed_out)
    return fmt::format("'{}' did not tell its version within {} s", name, kProbeSeconds);
  if (result.exit_code == kNotInstalled && probe.is_ours) {
    status.state = EngineState::kAbsent;
    return last_words(result.output_tail);
  }
  if (result.exit_code > kSignalBase)
    return fmt::format("'{}' --version ended with signal {}", name, result.exit_code - kSignalBase);
  if (result.exit_code != 0)
    return fmt::format("'{}' --version ended with exit code {}", name, result.exit_code);
  if (status.version.empty())
    return fmt::format("'{}' does not answer --version as {} does", name, engine.title);
  if (!is_supported(status.version, probe))
    return fmt::format("'{}' is {} {}; what can be driven is {}", name, engine.title,
                       status.version, engine.supported_versions);
  status.files = trace.files();
  return {};
}

/// Finds the program (`program` if not empty) and asks for its version.
EngineStatus probe_engine(const EngineInfo& engine, const EngineProbe& probe,
                          const std::filesystem::path& program) {
  EngineStatus status;
  const std::string wanted = !program.empty() ? program.string()
                             : probe.is_ours  ? find_companion(probe.program).string()
                                              : std::string(probe.program);
  status.program = find_program(wanted);
  if (status.program.empty()) {
    std::error_code ignored;
    // A file in $PATH that is not executable counts as absent, as in a shell.
    if (!program.empty() && std::filesystem::exists(program, ignored))
      status.state = EngineState::kBroken;
    status.why = !program.empty() ? fmt::format("'{}' is not a program", printable(wanted, 400))
                 : probe.is_ours  ? fmt::format("Lobelia was built without '{}'", probe.program)
                                  : fmt::format("no program '{}' in $PATH", probe.program);
    return status;
  }
  status.state = EngineState::kBroken;
  status.why = why_not_ready(engine, probe, status);
  if (status.why.empty()) status.state = EngineState::kReady;
  if (!status.available() || !probe.data) return status;
  std::vector<std::filesystem::path> programs = status.files.programs;
  programs.push_back(status.program);
  for (const auto& one : programs)
    std::ranges::copy(probe.data(one, status.version), std::back_inserter(status.files.data));
  return status;
}

}  // namespace

const EngineStatus& ProgramEngine::status() {
  if (!status_) status_ = probe_engine(info_, probe_, program_);
  return *status_;
}

void require_available(const EngineInfo& engine, const EngineStatus& status) {
  if (!status.available())
    throw Error(ExitCode::kEngine, "{} is {}: {}; to install it: {}", engine.title,
                status.state == EngineState::kBroken ? "broken" : "not available", status.why,
                engine.install_hint);
}

std::vector<std::string> engine_environment(const std::filesystem::path& directory) {
  std::vector<std::string> environment{"LC_ALL=C.UTF-8", "TZ=UTC"};
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "TMPDIR", "TMP", "TEMP"})
    environment.push_back(fmt::format("{}={}", name, directory.string()));
  for (const char* name : {"PATH", "LD_LIBRARY_PATH"})
    if (const char* value = std::getenv(name))
      environment.push_back(fmt::format("{}={}", name, value));
  return environment;
}

std::string last_words(const std::string& output_tail) {
  auto lines = split(output_tail, "\n");
  // Drop progress: our script's messages and Cycles' frames.
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
                   const std::filesystem::path& directory, ProcessOptions process,
                   const ReferenceOptions& options, ProcessResult& result) {
  bool started = false;
  process.working_directory = process.writable = process.progress_directory = directory;
  process.only_environment = true;
  process.no_progress_limit = options.no_progress_limit;
  process.memory_limit = options.memory_limit;
  process.disk_limit = options.disk_limit;
  process.on_start = [&started, told = std::move(process.on_start)](const ProcessLimits& limits) {
    started = true;
    if (told) told(limits);
  };
  try {
    result = run_process(arguments, process);
  } catch (const Error& error) {
    if (started) throw;  // from on_line or on_start
    return {find_program(arguments.front()).empty() ? FailureClass::kEngineMissing
                                                    : FailureClass::kCrash,
            error.what()};
  }
  if (result.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  Failure failure = process_failure(engine, result, options);
  // The directory is gone when someone reads the message.
  const std::string path = directory.string();
  for (std::size_t at; (at = failure.message.find(path)) != std::string::npos;)
    failure.message.replace(at, path.size(), kEngineDirectory);
  return failure;
}

std::uint64_t most_picture_bytes(const Film& film) {
  constexpr std::uint64_t kPerPixel = 1 << 10, kSmallest = 16 << 20;
  return kSmallest + kPerPixel * std::uint64_t(film.width) * std::uint64_t(film.height);
}

Failure read_engine_picture(const EngineInfo& engine, const std::filesystem::path& file,
                            const Film& film, Image& image) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    return {FailureClass::kNoOutput, fmt::format("{} wrote no picture", engine.title)};
  return read_engine_picture(
      engine, [&] { return PictureFile(file); }, film, image);
}

Failure read_engine_picture(const EngineInfo& engine, const std::function<PictureFile()>& open,
                            const Film& film, Image& image) {
  try {
    // Allows a larger picture too, so that the message can tell its size.
    const std::uint64_t pixels = 4 * std::uint64_t(film.width) * std::uint64_t(film.height);
    image = read_picture(open(), "", {std::max(pixels, kSmallPicture), 0}).image;
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

void EngineCost::add(const EngineCost& more) {
  seconds += more.seconds;
  cpu_seconds += more.cpu_seconds;
  peak_memory_bytes = std::max(peak_memory_bytes, more.peak_memory_bytes);
}

void record_limits(records::Reference& record, const ProcessLimits& limits) {
  record.writes_limited = limits.writes_limited;
  record.contained = containment_name(limits.contained);
}

void record_cost(records::Reference& record, const EngineCost& cost, int threads) {
  record.cpu_seconds = cost.cpu_seconds;
  record.peak_memory_bytes = cost.peak_memory_bytes;
  record.threads = threads;
}

records::Reference reference_record(const EngineInfo& engine, const EngineStatus& status,
                                    const Scene& scene) {
  records::Reference record;
  record.engine = {std::string(engine.name), std::string(engine.title), status.version};
  record.image = {"", scene.film.width, scene.film.height};
  return record;
}

ImageMetadata reference_metadata(const Scene& scene, const records::Reference& record) {
  ImageMetadata metadata = render_metadata(scene);
  metadata.emplace_back("lobelia:engine",
                        fmt::format("{} {}", record.engine.title, record.engine.version));
  metadata.emplace_back("lobelia:witness", record.shading);
  return metadata;
}

}  // namespace lobelia
