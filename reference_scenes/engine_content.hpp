// What an engine is beyond its version: the files that it runs, loads and reads.
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
  /// What was told so far, without what keeps the processes. Bounded, whatever was written there.
  EngineFiles files() const;

 private:
  std::filesystem::path directory_;
};

/// Of an engine that is ready. Empty for one that is no program: it is a part of ours. Reads only what `hashes` does
/// not know.
Content engine_content(const EngineStatus& status, FileHashes& hashes);

}  // namespace lobelia
