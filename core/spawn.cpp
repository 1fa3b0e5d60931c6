#include "core/spawn.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"

/// clone(2) by the other name that glibc has for it: what the thread sanitizer puts in place of the first takes the
/// child for a fork and keeps books in it, in our memory.
extern "C" int plain_clone(int (*)(void*), void* stack, int flags, void* argument,
                           ...) __asm__("__clone");

namespace lobelia {
namespace {

constexpr int kSignals = 64;
constexpr std::size_t kSignalSetBytes = kSignals / 8;  // the kernel's set; glibc's is longer
constexpr int kNotStarted = 127;

/// All that the child needs, made ready beforehand, and what it has to tell.
struct Child {
  char* const* arguments;
  char* const* environment;
  const char* working_directory;  // null: ours
  int input, output, ruleset;     // -1: /dev/null, -, none
  bool dies_with_us;
  pid_t parent;
  std::uint64_t keep;  // bit i: leave signal i + 1 as it is
  sigset_t mask;
  bool writes_limited = false;
  int error = 0;
};

/// What the child does until it is the program. It has our memory while the calling thread stands still, so it may
/// neither allocate nor lock, and a handler of ours must never run in it. System calls alone, and no sanitizer, whose
/// books are ours too.
__attribute__((noinline, no_sanitize("address", "thread", "undefined"))) int become(
    void* argument) {
  Child& child = *static_cast<Child*>(argument);
  const std::uint64_t default_action[8] = {};  // of the kernel's structure: all zeros
  for (int i = 0; i < kSignals; ++i)
    if (!(child.keep >> i & 1))
      ::syscall(SYS_rt_sigaction, i + 1, default_action, nullptr, kSignalSetBytes);
  bool ready = ::syscall(SYS_setpgid, 0, 0) == 0;
  int input = child.input;
  if (ready && input < 0)
    ready =
        (input = int(::syscall(SYS_openat, AT_FDCWD, "/dev/null", O_RDONLY | O_CLOEXEC, 0))) >= 0;
  const int descriptors[3] = {input, child.output, child.output};
  for (int i = 0; i < 3; ++i)  // one that is in its place already only has to stay open
    ready = ready && (descriptors[i] == i ? ::syscall(SYS_fcntl, i, F_SETFD, 0)
                                          : ::syscall(SYS_dup3, descriptors[i], i, 0)) >= 0;
  if (ready && child.working_directory) ready = ::syscall(SYS_chdir, child.working_directory) == 0;
  if (ready && child.dies_with_us) {
    ready = ::syscall(SYS_prctl, PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0) == 0;
    // It may have died before that.
    if (::syscall(SYS_getppid) != child.parent) return kNotStarted;
  }
  // Without root's rights the kernel wants to be sure that no set-user-ID program is misled.
  if (ready && child.ruleset >= 0)
    child.writes_limited = ::syscall(SYS_prctl, PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                           ::syscall(SYS_landlock_restrict_self, child.ruleset, 0) == 0;
  if (ready) {
    ::syscall(SYS_rt_sigprocmask, SIG_SETMASK, &child.mask, nullptr, kSignalSetBytes);
    ::syscall(SYS_execve, child.arguments[0], child.arguments, child.environment);
  }
  child.error = errno;
  return kNotStarted;
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (const auto& text : texts) result.push_back(const_cast<char*>(text.c_str()));
  result.push_back(nullptr);
  return result;
}

std::uint64_t ignored_signals() {
  std::uint64_t result = 0;
  for (int i = 0; i < kSignals; ++i) {
    struct sigaction action {};
    if (::sigaction(i + 1, nullptr, &action) == 0 && action.sa_handler == SIG_IGN)
      result |= std::uint64_t{1} << i;
  }
  return result;
}

}  // namespace

Spawned spawn(const SpawnRequest& request) {
  const std::vector<char*> arguments = pointers(request.arguments);
  const std::vector<char*> environment = pointers(request.environment);
  Child child{.arguments = arguments.data(),
              .environment = environment.data(),
              .working_directory =
                  request.working_directory.empty() ? nullptr : request.working_directory.c_str(),
              .input = request.input,
              .output = request.output,
              .ruleset = request.limit ? request.limit->ruleset() : -1,
              .dies_with_us = request.dies_with_us,
              .parent = ::getpid(),
              .keep = ignored_signals(),
              .mask = {}};
  alignas(16) std::array<std::byte, 16384> stack;
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &child.mask);
  // posix_spawn does the same, but has no word for PR_SET_PDEATHSIG and for Landlock.
  const pid_t pid =
      plain_clone(become, stack.data() + stack.size(), CLONE_VM | CLONE_VFORK | SIGCHLD, &child);
  const int error = pid < 0 ? errno : child.error;
  ::pthread_sigmask(SIG_SETMASK, &child.mask, nullptr);
  if (error != 0) {
    if (pid > 0) ::waitpid(pid, nullptr, 0);
    throw Error(ExitCode::kEngine, fmt::format("{}: cannot be started: {}",
                                               request.arguments.front(), std::strerror(error)));
  }
  return {pid, child.writes_limited};
}

}  // namespace lobelia
