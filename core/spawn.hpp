// Starting another program in a process group of its own, as quickly from a large process as from a small one.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/write_limit.hpp"

namespace lobelia {

/// How surely everything ends that came of a program.
enum class Containment {
  kNone,       ///< its process group is killed, and that is all
  kSubreaper,  ///< its keeper kills all descendants; a hostile program could kill the keeper first
  kPidNamespace,  ///< the kernel kills all of them
};
inline constexpr std::string_view kContainmentNames[] = {"none", "subreaper", "pid namespace"};
constexpr std::string_view containment_name(Containment containment) {
  return kContainmentNames[std::size_t(containment)];
}

struct SpawnRequest {
  std::vector<std::string> arguments;       ///< the first is the program's path
  std::vector<std::string> environment;     ///< "NAME=value", all of it
  std::filesystem::path working_directory;  ///< empty: ours
  int input = -1;                           ///< its stdin; -1: /dev/null
  int output = -1;                          ///< its stdout and stderr
  const WriteLimit* limit = nullptr;        ///< what it is held to, if anything
  std::uint64_t largest_file = 0;           ///< bytes that a file may come to; 0: any number
  /// It is a keeper (core/process_keeper.cpp), whose line to us this is: process 1 of a PID namespace if the kernel allows
  /// that. Then the kernel kills it as soon as the calling *thread* ends, however that comes: it has to wait. -1: none.
  int keeper_line = -1;
};

struct Spawned {
  pid_t pid = 0;                ///< its process group's as well
  bool writes_limited = false;  ///< the kernel took the limit
  Containment contained = Containment::kNone;
};

/// Signals that we ignore or block are so in the program, all others have their default action. $LOBELIA_NO_NAMESPACE
/// leaves the PID namespace out. Throws Error(kEngine), naming the program and why, if it cannot be started.
Spawned spawn(const SpawnRequest& request);

}  // namespace lobelia
