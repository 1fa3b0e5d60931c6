// What the system refuses for want of something, said so that a person knows what to raise.
#pragma once

#include <exception>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace lobelia {

/// "not enough memory (ulimit -v or -d, cgroup memory.max)" for ENOMEM; likewise of threads and processes (EAGAIN) and
/// of open files (EMFILE, ENFILE). Empty of any other error of a system call.
std::string lacking(int error);

/// Error(ExitCode::kNoResources) if lacking(), else of `otherwise`: "WHAT: WHY".
Error failure_of(const std::string& what, int error, ExitCode otherwise);

/// What a library's exception means by that: of memory (std::bad_alloc) and of threads, which libraries word as they
/// like. Empty if it means something else.
std::string lacking(const std::exception& error);

}  // namespace lobelia
