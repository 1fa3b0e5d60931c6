// The files that an engine runs, loads and reads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference_scenes/content.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia {

/// Finds the programs that a process tree runs and the libraries that it loads, including those of dlopen(), from the log of
/// glibc's loader (LD_DEBUG=files, ld.so(8)). Costs a few milliseconds.
class LoaderTrace {
 public:
  /// `directory` is private and exists while the processes run.
  explicit LoaderTrace(std::filesystem::path directory) : directory_(std::move(directory)) {}
  std::vector<std::string> environment() const;
  /// The files that the loader has named so far, without Lobelia's own programs. Their number is bounded.
  EngineFiles files() const;

 private:
  std::filesystem::path directory_;
};

/// The content of an engine that is ready; empty for one that is part of Lobelia. Reads only files that `hashes` does not know.
Content engine_content(const EngineStatus& status, FileHashes& hashes);

}  // namespace lobelia
