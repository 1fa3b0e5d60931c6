// Running an engine's program: finding it, asking for its version, and saying in one line why it failed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/pictures/picture_file.hpp"
#include "base/system/process.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia {

/// How to find an engine's program and ask for its version.
struct EngineProbe {
  std::string_view program;  ///< as in $PATH
  std::string_view
      version_prefix;  ///< text before the version in the output of --version: "Blender "
  bool (*supports)(int major, int minor) = nullptr;  ///< EngineInfo::supported_versions
  /// The files and directories that a program of this version reads; not all need exist. Null: none.
  std::vector<std::filesystem::path> (*data)(const std::filesystem::path& program,
                                             std::string_view version) = nullptr;
  bool is_ours = false;  ///< a program that lies beside ours and was built with it
};

/// An engine that is a program. Both references must outlive it.
class ProgramEngine : public Engine {
 public:
  ProgramEngine(const EngineInfo& info, const EngineProbe& probe, std::filesystem::path program)
      : info_(info), probe_(probe), program_(std::move(program)) {}
  const EngineInfo& info() const final { return info_; }
  const EngineStatus& status() final;

 private:
  const EngineInfo& info_;
  const EngineProbe& probe_;
  const std::filesystem::path program_;  ///< empty: the one in $PATH
  std::optional<EngineStatus> status_;
};

/// The whole environment of an engine: $PATH and $LD_LIBRARY_PATH, a fixed language and time zone, and `directory` as home
/// directory, without settings and with room for caches and temporary files. Other variables could change its pictures
/// (CYCLES_*, OCIO, PYTHON*) or how it runs (LD_PRELOAD, GLIBC_TUNABLES, MALLOC_*, OMP_*).
std::vector<std::string> engine_environment(const std::filesystem::path& directory);

/// The part of an engine's output that explains a failure, in one line.
std::string last_words(const std::string& output_tail);

/// Why a process failed: "POV-Ray stopped with exit code 1: ...".
Failure process_failure(const EngineInfo& engine, const ProcessResult& result,
                        const ReferenceOptions& options);

/// run_process() with the limits of `options` and only `process.environment`, in `directory`, the only place where it may
/// write. A program that does not start is a failure. Throws Error(kInterrupted).
Failure run_engine(const EngineInfo& engine, const std::vector<std::string>& arguments,
                   const std::filesystem::path& directory, ProcessOptions process,
                   const ReferenceOptions& options, ProcessResult& result);

/// Bytes that a picture of this film may have: those of 64 layers of four floats, and more for small ones.
std::uint64_t most_picture_bytes(const Film& film);

/// Reads a picture, which must have the film's size.
Failure read_engine_picture(const EngineInfo& engine, const std::filesystem::path& file,
                            const Film& film, Image& image);
/// The same for a file that `open` opens.
Failure read_engine_picture(const EngineInfo& engine, const std::function<PictureFile()>& open,
                            const Film& film, Image& image);

/// The result of a scene without a picture, or before it has one.
ReferenceResult failed_result(const EngineInfo& engine, const EngineStatus& status,
                              const Scene& scene, const Failure& failure);

/// ReferenceOptions::threads, or one for each processor.
int threads_of(const ReferenceOptions& options);

/// The beginning of an engine's output on one scene.
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

/// The time and memory of an engine's processes.
struct EngineCost {
  double seconds = 0;  ///< wall time
  double cpu_seconds = 0;
  std::uint64_t peak_memory_bytes = 0;  ///< of the largest process
  void add(const EngineCost& more);
};

/// Writes into a record how an engine's processes were contained.
void record_limits(records::Reference& record, const ProcessLimits& limits);

/// Writes a cost into a record, with the number of threads of each process.
void record_cost(records::Reference& record, const EngineCost& cost, int threads);

/// A record with the fields that all engines fill in alike.
records::Reference reference_record(const EngineInfo& engine, const EngineStatus& status,
                                    const Scene& scene);

}  // namespace lobelia
