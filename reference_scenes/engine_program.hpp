// Finding an engine's program, asking its version, and saying in one line why it failed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/process.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia {

/// How to find an engine's program and ask its version.
struct EngineProbe {
  std::string_view program;         ///< as in $PATH
  std::string_view version_prefix;  ///< what stands before the version in `--version`: "Blender "
  bool (*supports)(int major, int minor) = nullptr;  ///< EngineInfo::supported_versions
  /// Where a program of this version has its scripts and data; those that are not there do no harm. Null: nowhere.
  std::vector<std::filesystem::path> (*directories)(const std::filesystem::path& program,
                                                    std::string_view version) = nullptr;
};

/// Looks for the program (`program` if not empty) and runs it with --version.
EngineStatus probe_engine(const EngineInfo& engine, const EngineProbe& probe,
                          const std::filesystem::path& program);

/// An engine that is a program. Both references must outlive it.
class ProgramEngine : public Engine {
 public:
  ProgramEngine(const EngineInfo& info, const EngineProbe& probe, std::filesystem::path program)
      : info_(info), probe_(probe), program_(std::move(program)) {}
  const EngineInfo& info() const final { return info_; }
  const EngineStatus& status() final {
    if (!status_) status_ = probe_engine(info_, probe_, program_);
    return *status_;
  }

 private:
  const EngineInfo& info_;
  const EngineProbe& probe_;
  const std::filesystem::path program_;
  std::optional<EngineStatus> status_;
};

/// All that an engine gets of our environment: other variables could change its pictures (CYCLES_*, OCIO, PYTHON*) or how it
/// runs (LD_PRELOAD, GLIBC_TUNABLES, MALLOC_*, OMP_*).
inline constexpr const char* kPassedOn[] = {"PATH", "LD_LIBRARY_PATH"};

/// The whole environment of an engine: kPassedOn, one language and time zone for all, and `directory` in place of the
/// user's home, where it finds no settings and leaves its caches and temporary files.
std::vector<std::string> engine_environment(const std::filesystem::path& directory);

/// The most telling words of an engine's output about a failure, in one line.
std::string last_words(const std::string& output_tail);

/// Why a process failed: "POV-Ray stopped with exit code 1: ...". Nothing if it ended as it should.
Failure process_failure(const EngineInfo& engine, const ProcessResult& result,
                        const ReferenceOptions& options);

/// run_process in `process.environment` and nothing else; one that cannot be started is a failure. Throws
/// Error(kInterrupted).
Failure run_engine(const EngineInfo& engine, const std::vector<std::string>& arguments,
                   ProcessOptions process, const ReferenceOptions& options, ProcessResult& result);

/// Reads what should be a picture of the film's size.
Failure read_engine_picture(const EngineInfo& engine, const std::filesystem::path& file,
                            const Film& film, Image& image);

/// A scene's result where there is no picture.
ReferenceResult failed_result(const EngineInfo& engine, const EngineStatus& status,
                              const Scene& scene, const Failure& failure);

/// As many as were asked for, or one for each processor.
int threads_of(const ReferenceOptions& options);

/// An engine's output on one scene; of one that never ends what it says, the beginning.
class EngineLog {
 public:
  void add(std::string_view line) {
    if (text_.size() < kMost) text_.append(line).append("\n");
  }
  const std::string& text() const { return text_; }

 private:
  static constexpr std::size_t kMost = 1 << 20;
  std::string text_;
};

/// The limits that hold for both of two processes.
ProcessLimits weaker(const ProcessLimits& a, const ProcessLimits& b);

/// Writes into a record how an engine's processes were contained.
void record_limits(records::Reference& record, const ProcessLimits& limits);

/// Writes into a record what a program took.
void record_cost(records::Reference& record, double cpu_seconds, std::uint64_t peak_memory_bytes,
                 int threads);

/// The record, as far as all engines fill it alike.
records::Reference reference_record(const EngineInfo& engine, const EngineStatus& status,
                                    const Scene& scene);

}  // namespace lobelia
