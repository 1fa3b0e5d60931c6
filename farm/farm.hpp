// The farm: every cell of a grid rendered by us and by the reference engines, compared, and recorded
// as docs/records.md says. What is there already and still current is kept.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "farm/grid.hpp"

namespace lobelia {

struct FarmProgress {
  std::size_t done = 0, total = 0;  ///< steps: one a picture, one a cell's comparison
  std::string running;              ///< "lobelia 108/108, povray 17/108"
};

struct FarmOptions {
  std::map<std::string, std::filesystem::path> programs;  ///< in place of those in $PATH, by engine
  int threads = 0;                                        ///< 0: all processors
  std::chrono::duration<double> time_limit = std::chrono::minutes(10);  ///< for each picture
  bool again = false;                                                   ///< make everything again
  std::vector<std::string> command;                                     ///< for the record
  std::function<void(const FarmProgress&)> on_progress;                 ///< from any thread
};

struct FarmSummary {
  std::size_t cells = 0, pass = 0, differs = 0, failed = 0, missing = 0;
  std::size_t foreign = 0;                  ///< directories under cells/ that are not of this grid
  std::size_t undecided = 0;                ///< cells whose pictures are too noisy to tell
  std::size_t unchecked = 0;                ///< cells with no engine to compare with
  std::size_t rendered = 0, kept = 0;       ///< pictures
  std::vector<std::string> absent_engines;  ///< sentences: which, why, how to get it
  std::set<std::string> warnings;           ///< of the cells' highlights, each once
  std::vector<std::string> problems;        ///< "cell: engine: message"
};

/// Throws Error(kInterrupted) on Ctrl-C, after farm.json has been written with what is done;
/// Error(kOutput) if the directory cannot be written; Error(kEngine) if one of `programs` is not
/// the engine that it should be.
FarmSummary run_farm(const Grid& grid, const std::filesystem::path& directory,
                     const FarmOptions& options);

}  // namespace lobelia
