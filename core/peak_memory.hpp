// How much memory a program has had, as the kernel tells from outside.
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace lobelia {

/// The most resident bytes of a process since it became its program; 0 if it has ended. getrusage and wait4 say something
/// else: a process takes over the peak of the one that started it, and keeps it as the least that it may have had.
std::uint64_t peak_memory_of(pid_t process);

/// Of the process and those that it has started, and they in turn, the largest.
std::uint64_t peak_memory_of_family(pid_t process);

}  // namespace lobelia
