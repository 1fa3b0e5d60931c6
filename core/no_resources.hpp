// Errors for lack of memory, threads, processes or open files, with the limit to raise.
#pragma once

#include <exception>
#include <string>

#include "core/error.hpp"

namespace lobelia {

/// "not enough memory (ulimit -v or -d, cgroup memory.max)" for ENOMEM, and the like for threads and processes (EAGAIN)
/// and open files (EMFILE, ENFILE). Empty for any other errno.
std::string lacking(int error);

/// Error(ExitCode::kNoResources) if lacking(), else of `otherwise`: "WHAT: WHY".
Error failure_of(const std::string& what, int error, ExitCode otherwise);

/// The same for an exception of a library: std::bad_alloc, or a message about memory or threads.
std::string lacking(const std::exception& error);
Error failure_of(const std::string& what, const std::exception& error, ExitCode otherwise);

}  // namespace lobelia
