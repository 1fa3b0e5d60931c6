// Starting another program in a process group of its own, as quickly from a large process as from a small one.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/write_limit.hpp"

namespace lobelia {

struct SpawnRequest {
  std::vector<std::string> arguments;       ///< the first is the program's path
  std::vector<std::string> environment;     ///< "NAME=value", all of it
  std::filesystem::path working_directory;  ///< empty: ours
  int input = -1;                           ///< its stdin; -1: /dev/null
  int output = -1;                          ///< its stdout and stderr
  const WriteLimit* limit = nullptr;        ///< what it is held to, if anything
  /// The kernel kills it as soon as the calling *thread* ends, however that comes: it has to wait.
  bool dies_with_us = false;
};

struct Spawned {
  pid_t pid = 0;                ///< its process group's as well
  bool writes_limited = false;  ///< the kernel took the limit
};

/// Signals that we ignore or block are so in the program, all others have their default action.
/// Throws Error(kEngine), naming the program and why, if it cannot be started.
Spawned spawn(const SpawnRequest& request);

}  // namespace lobelia
