// Errors of the system: lack of memory, threads, processes or open files, with the limit to raise; faults of disks.
#pragma once

#include <exception>
#include <filesystem>
#include <string>

#include "base/system/error.hpp"

namespace lobelia {

/// "not enough memory (ulimit -v or -d, cgroup memory.max)" for ENOMEM, and the like for threads and processes (EAGAIN)
/// and open files (EMFILE, ENFILE). Empty for any other errno.
std::string lacking(int error);

/// Error(ExitCode::kNoResources) if lacking(), else of `otherwise`: "WHAT: WHY".
Error failure_of(const std::string& what, int error, ExitCode otherwise);

/// Throws that of "PATH: cannot write" and kOutput.
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error);

/// The same for an exception of a library: std::bad_alloc, or a message about memory or threads.
std::string lacking(const std::exception& error);
Error failure_of(const std::string& what, const std::exception& error, ExitCode otherwise);

/// Whether an errno tells how a file is: missing, not allowed, behind a circle of links. Any other, such as EIO, ESTALE or
/// EINTR, says that the system could not look, so nothing is known of the file.
bool tells_of_file(int error);

/// For an exception that nothing expects. kNoResources if lacking(), or if the system refused a thread or a lock. Where
/// std::filesystem failed, "PATH: WHAT: WHY" with kInput, or kOutput if there is no room or nothing may be written.
/// Otherwise kInternal.
Error as_error(const std::exception& error);

}  // namespace lobelia
