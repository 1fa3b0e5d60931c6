#include "base/system/no_resources.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

namespace lobelia {

std::string lacking(int error) {
  switch (error) {
    case EAGAIN:
      return "the system allows no more threads or processes (ulimit -u, cgroup pids.max), or no memory for their "
             "stacks (ulimit -v)";
    case ENOMEM:
      return "not enough memory (ulimit -v or -d, cgroup memory.max)";
    case EMFILE:
    case ENFILE:
      return "too many open files (ulimit -n)";
    default:
      return "";
  }
}

namespace {
/// The errno in an exception of the standard library; 0 if there is none.
int errno_of(const std::exception& error) {
  const auto* const system = dynamic_cast<const std::system_error*>(&error);
  if (!system) return 0;
  const std::error_category& category = system->code().category();
  const bool is_errno = category == std::generic_category() || category == std::system_category();
  return is_errno ? system->code().value() : 0;
}
}  // namespace

std::string lacking(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return lacking(ENOMEM);
  if (const int number = errno_of(error)) return lacking(number);
  // The messages of oneTBB and OpenEXR contain the system's words or std::bad_alloc. The dynamic linker names the library
  // that does not fit.
  const std::string_view words = error.what();
  for (const int one : {EAGAIN, ENOMEM, EMFILE})
    if (words.find(std::strerror(one)) != words.npos) return lacking(one);
  for (const char* memory_word :
       {"std::bad_alloc", "out of memory", "cannot allocate",
        // of glibc's dynamic loader
        "failed to map segment", "cannot map zero-fill pages", "cannot change memory protections",
        "cannot extend global scope", "cannot create cache", "cannot create scope list",
        "cannot create search path", "cannot create shared object", "cannot create RUNPATH",
        "cannot create TLS",
        // of oneTBB
        "pthread_create has failed"})
    if (words.find(memory_word) != words.npos) return lacking(ENOMEM);
  return "";
}

namespace {
Error failure_of(const std::string& what, const std::string& lack, const char* why,
                 ExitCode otherwise) {
  return Error(lack.empty() ? otherwise : ExitCode::kNoResources,
               fmt::format("{}: {}", what, lack.empty() ? why : lack));
}
}  // namespace

Error failure_of(const std::string& what, int error, ExitCode otherwise) {
  return failure_of(what, lacking(error), std::strerror(error), otherwise)
      .set_fault(!tells_of_file(error));
}

void cannot_write(const std::filesystem::path& path, int error) {
  throw failure_of(path.string() + ": cannot write", error, ExitCode::kOutput);
}

Error failure_of(const std::string& what, const std::exception& error, ExitCode otherwise) {
  return failure_of(what, lacking(error), error.what(), otherwise);
}

bool tells_of_file(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
    case EACCES:
    case EPERM:
    case ELOOP:
    case ENAMETOOLONG:
      return true;
    default:
      return false;
  }
}

Error as_error(const std::exception& error) {
  const auto* const of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  if (!of_file) {
    if (const std::string lack = lacking(error); !lack.empty())
      return Error(ExitCode::kNoResources, lack);
    // Threads and locks throw it, with no other words than errno's. A lock that would wait for itself is a bug of ours.
    if (const int number = errno_of(error); number != 0 && number != EDEADLK)
      return Error(ExitCode::kNoResources, "the system refuses a thread or a lock: {}",
                   error.what());
    return Error(ExitCode::kInternal, "internal error: {}", error.what());
  }
  // "filesystem error: WHAT: WHY [PATH]"
  constexpr std::string_view kPrefix = "filesystem error: ";
  std::string_view what = error.what();
  if (what.starts_with(kPrefix)) what.remove_prefix(kPrefix.size());
  what = what.substr(0, what.find(": " + of_file->code().message()));
  const std::string path = of_file->path1().string();
  const int number = of_file->code().value();
  const bool is_output = number == ENOSPC || number == EDQUOT || number == EROFS;
  return failure_of(fmt::format("{}{}{}", path, path.empty() ? "" : ": ", what), number,
                    is_output ? ExitCode::kOutput : ExitCode::kInput);
}

}  // namespace lobelia
