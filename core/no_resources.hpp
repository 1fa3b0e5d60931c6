// Errors for want of memory, threads, processes or open files, with the limit to raise.
#pragma once

#include <exception>
#include <string>

#include "core/error.hpp"

namespace lobelia {

/// "not enough memory (ulimit -v or -d, cgroup memory.max)" for ENOMEM; likewise of threads and processes (EAGAIN) and
/// of open files (EMFILE, ENFILE). Empty of any other error of a system call.
std::string lacking(int error);

/// Error(ExitCode::kNoResources) if lacking(), else of `otherwise`: "WHAT: WHY".
Error failure_of(const std::string& what, int error, ExitCode otherwise);

/// The same for an exception of a library: std::bad_alloc, or one whose words say that memory or threads ran out.
std::string lacking(const std::exception& error);
Error failure_of(const std::string& what, const std::exception& error, ExitCode otherwise);

}  // namespace lobelia
