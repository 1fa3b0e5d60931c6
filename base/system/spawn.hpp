// Starts another program in a process group of its own, as fast from a large process as from a small one.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/write_limit.hpp"

namespace lobelia {

/// How everything that a program started is ended.
enum class Containment {
  kNone,       ///< only its process group is killed
  kSubreaper,  ///< its keeper kills all descendants, but a hostile program could kill the keeper first
  kPidNamespace,  ///< the kernel kills all descendants
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
  const WriteLimit* limit = nullptr;        ///< null: none
  std::uint64_t largest_file = 0;           ///< bytes of each file that it may write; 0: no limit
  /// A keeper's end of its socket (base/system/keeper_protocol.hpp); -1: the program is no keeper. A keeper becomes
  /// process 1 of a PID namespace if the kernel allows it, and is then killed when the calling *thread* ends: the thread
  /// must wait.
  int keeper_line = -1;
};

struct Spawned {
  pid_t pid = 0;                ///< its process group's as well
  bool writes_limited = false;  ///< the kernel applies the limit
  Containment contained = Containment::kNone;
};

/// The program inherits our ignored and blocked signals; all others have their default action. $LOBELIA_NO_NAMESPACE
/// turns PID namespaces off. Throws Error(kEngine), naming the program and the reason, if it cannot be started.
Spawned spawn(const SpawnRequest& request);

}  // namespace lobelia
