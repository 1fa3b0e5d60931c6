// The content of an engine beyond its version: the files that it runs, loads and reads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference_scenes/content.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia {

/// A process tree that tells which programs it runs and which libraries it loads, also those that dlopen() finds:
/// glibc's loader writes that (LD_DEBUG=files, ld.so(8)). Costs a few milliseconds.
class LoaderTrace {
 public:
  /// `directory` is private, and there as long as the processes run.
  explicit LoaderTrace(std::filesystem::path directory) : directory_(std::move(directory)) {}
  std::vector<std::string> environment() const;
  /// The files that the loader has named so far, without our own keeper. Their number is bounded.
  EngineFiles files() const;

 private:
  std::filesystem::path directory_;
};

/// The content of an engine that is ready. Empty if it is part of ours. Reads only files that `hashes` does not know.
Content engine_content(const EngineStatus& status, FileHashes& hashes);

}  // namespace lobelia
