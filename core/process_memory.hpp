// The memory of other processes, as the kernel counts it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace lobelia {

/// The most resident bytes of a process since it became its program; 0 if it has ended. getrusage says something else: a
/// process takes over the peak of the one that started it, and keeps it as the least that it may have had.
std::uint64_t peak_memory_of(pid_t process);

/// Resident bytes of a process and its descendants. Shared pages count once if `exactly` (PSS, for which the kernel
/// looks at every page), else once for each process. 0 if it has ended or if /proc is of another PID namespace.
std::uint64_t memory_of_tree(pid_t process, bool exactly = false);

/// How many processes this kernel has killed for want of memory since it started; nothing where it does not tell.
std::optional<std::uint64_t> count_of_oom_kills();

/// Bytes of memory that this machine has.
std::uint64_t memory_of_machine();

}  // namespace lobelia
