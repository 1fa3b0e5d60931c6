// This machine, its processes, and this build of the program.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace lobelia {

/// "Intel(R) Xeon(R) Processor"; "unknown" if the system does not tell.
std::string processor_name();

/// "node17"; empty if the system does not tell.
std::string host_name();

/// Whether /proc has our process IDs: not in a PID namespace without a /proc of its own.
bool proc_has_our_numbers();

/// The part of /proc/PID/stat that tells one process from another.
struct ProcessStat {
  char state = 0;           ///< 'R', 'S', ...; 0: unknown
  std::uint64_t start = 0;  ///< in ticks since the machine was started
  /// Killed, and its parent does not ask for it, as in a container without an init.
  bool has_ended() const { return state == 'Z' || state == 'X'; }
};
/// `process` is a PID or "self".
ProcessStat stat_of_process(const std::string& process);

/// Bytes of memory that this machine has.
std::uint64_t memory_of_machine();

/// Peak resident bytes of a process since its exec; 0 if it has ended. getrusage differs: it includes the peak of the
/// process that started it.
std::uint64_t peak_memory_of(pid_t process);

/// Resident bytes of a process and its descendants. Shared pages count once for each process, or with `exactly` once in
/// all (PSS, for which the kernel looks at every page). 0 if it has ended or /proc is of another PID namespace.
std::uint64_t memory_of_tree(pid_t process, bool exactly = false);

/// How many processes this kernel has killed for lack of memory since it started; nothing if it does not tell.
std::optional<std::uint64_t> count_of_oom_kills();

/// The file of this process's program, without links. By /proc, or where that is missing or cannot be read by the path that
/// the kernel started it from. Throws Error(kInput) if neither leads to a file.
std::filesystem::path program_file();

/// The file with this code, without links: the program, or a shared library such as the Python module. Throws
/// Error(kInput) if it cannot be found.
std::filesystem::path own_file();

/// The GNU build ID of own_file() in hexadecimal, which is the same for the same code; without one, the SHA-256 of the
/// file. Throws Error(kInput) if neither can be read.
const std::string& build_id();

}  // namespace lobelia
