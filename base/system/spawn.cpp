#include "base/system/spawn.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/system/error.hpp"
#include "base/system/no_resources.hpp"

/// clone(2) under glibc's other name. The thread sanitizer replaces the first name, takes the child for a fork and does
/// its bookkeeping there, in our memory.
extern "C" int plain_clone(int (*)(void*), void* stack, int flags, void* argument,
                           ...) __asm__("__clone");

/// Functions that run between clone() and execve(), in our address space while the calling thread waits: system calls
/// only, no allocation, no locks, and no sanitizer.
#define LOBELIA_IN_CHILD __attribute__((noinline, no_sanitize("address", "thread", "undefined")))

namespace lobelia {
namespace {

constexpr int kSignals = 64;
constexpr std::size_t kSignalSetBytes = kSignals / 8;  // the kernel's set; glibc's is longer
constexpr int kNotStarted = 127;

/// Data that the parent prepares for the child, and the child's report.
struct Child {
  char* const* arguments;
  char* const* environment;
  const char* working_directory;  // null: ours
  int input, output, line;        // input -1: /dev/null; line -1: none
  int ruleset;                    // -1: none
  std::uint64_t ignored;          // bit i: signal i + 1 stays ignored
  rlimit largest_file;            // 0: no limit
  // The maps of a new user namespace, which get our user and group only; null: no such namespace.
  const char *user_map = nullptr, *group_map = nullptr;
  std::size_t user_map_size = 0, group_map_size = 0;
  bool dies_with_us = false;
  sigset_t mask;
  bool writes_limited = false;
  int error = 0;
};

constexpr int kFirstFreeDescriptor = 10;  // above those that a program gets

LOBELIA_IN_CHILD bool write_text(const char* file, const char* text, std::size_t size) {
  const int descriptor = int(::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CLOEXEC, 0));
  return descriptor >= 0 && ::syscall(SYS_write, descriptor, text, size) == long(size) &&
         ::syscall(SYS_close, descriptor) == 0;
}

/// Moves a descriptor above those that a program gets. False with errno.
LOBELIA_IN_CHILD bool move_up(int& descriptor) {
  descriptor = int(::syscall(SYS_fcntl, descriptor, F_DUPFD_CLOEXEC, kFirstFreeDescriptor));
  return descriptor >= 0;
}

/// Gives the program its descriptors 0, 1, 2 and maybe 3. Moves `ruleset` if it is in the way. False with errno.
LOBELIA_IN_CHILD bool set_descriptors(const Child& child, int& ruleset) {
  int input = child.input;
  if (input < 0) input = int(::syscall(SYS_openat, AT_FDCWD, "/dev/null", O_RDONLY | O_CLOEXEC, 0));
  if (input < 0) return false;
  int descriptors[4] = {input, child.output, child.output, child.line};
  const int wanted = child.line >= 0 ? 4 : 3;
  if (ruleset >= 0 && ruleset < wanted && !move_up(ruleset)) return false;
  for (int i = 0; i < wanted; ++i)
    if (descriptors[i] != i && descriptors[i] < wanted && !move_up(descriptors[i])) return false;
  for (int i = 0; i < wanted; ++i)  // one that has its number already only has to stay open
    if ((descriptors[i] == i ? ::syscall(SYS_fcntl, i, F_SETFD, 0)
                             : ::syscall(SYS_dup3, descriptors[i], i, 0)) < 0)
      return false;
  return true;
}

/// Everything before execve(). False with errno.
LOBELIA_IN_CHILD bool prepare_child(Child& child) {
  const std::uint64_t default_action[8] = {};  // the kernel's structure, all zeros
  for (int i = 0; i < kSignals; ++i)           // none of our handlers may run here
    if (!(child.ignored >> i & 1))
      ::syscall(SYS_rt_sigaction, i + 1, default_action, nullptr, kSignalSetBytes);
  if (::syscall(SYS_setpgid, 0, 0) != 0) return false;
  // The kernel accepts a group map only from a process that cannot drop groups.
  if (child.user_map && !(write_text("/proc/self/setgroups", "deny", 4) &&
                          write_text("/proc/self/uid_map", child.user_map, child.user_map_size) &&
                          write_text("/proc/self/gid_map", child.group_map, child.group_map_size)))
    return false;
  int ruleset = child.ruleset;
  if (!set_descriptors(child, ruleset)) return false;
  if (child.working_directory && ::syscall(SYS_chdir, child.working_directory) != 0) return false;
  // If we have died before this call, the keeper finds its line closed.
  if (child.dies_with_us && ::syscall(SYS_prctl, PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0) != 0)
    return false;
  if (child.largest_file.rlim_cur > 0 &&
      ::syscall(SYS_prlimit64, 0, RLIMIT_FSIZE, &child.largest_file, nullptr) != 0)
    return false;
  if (ruleset < 0) return true;
  // Without root's rights the kernel demands PR_SET_NO_NEW_PRIVS, so that no set-user-ID program is misled.
  child.writes_limited = ::syscall(SYS_prctl, PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                         ::syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
  return child.writes_limited;
}

LOBELIA_IN_CHILD int exec_child(void* argument) {
  Child& child = *static_cast<Child*>(argument);
  if (prepare_child(child)) {
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

/// Calls clone(2) with these namespaces and returns once the child has called execve(). Returns 0 or an errno.
int start(Child& child, unsigned long namespaces, pid_t& pid) {
  alignas(16) std::array<std::byte, 16384> stack;
  child.error = 0;
  // posix_spawn has no namespaces, PR_SET_PDEATHSIG and Landlock.
  pid = plain_clone(exec_child, stack.data() + stack.size(),
                    int(CLONE_VM | CLONE_VFORK | SIGCHLD | namespaces), &child);
  if (pid < 0) return errno;
  if (child.error != 0) ::waitpid(pid, nullptr, 0);
  return child.error;
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
              .line = request.keeper_line,
              .ruleset = request.limit ? request.limit->ruleset() : -1,
              .ignored = ignored_signals(),
              .largest_file = {request.largest_file, request.largest_file},
              .mask = {}};
  // If SIGXFSZ were ignored, a file over the limit would be an error like any other.
  if (request.largest_file > 0) child.ignored &= ~(std::uint64_t{1} << (SIGXFSZ - 1));
  const std::string user_map = fmt::format("{0} {0} 1", ::geteuid()),
                    group_map = fmt::format("{0} {0} 1", ::getegid());
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &child.mask);
  pid_t pid = 0;
  int error = EPERM;
  Containment contained = Containment::kNone;
  if (request.keeper_line >= 0) {
    contained = Containment::kPidNamespace;
    child.dies_with_us = true;
    if (!std::getenv("LOBELIA_NO_NAMESPACE")) {
      error = start(child, CLONE_NEWPID, pid);
      if (error == EPERM) {  // without root's rights
        child.user_map = user_map.c_str();
        child.user_map_size = user_map.size();
        child.group_map = group_map.c_str();
        child.group_map_size = group_map.size();
        error = start(child, CLONE_NEWPID | CLONE_NEWUSER, pid);
        child.user_map = nullptr;
      }
    }
    // Without a namespace the program can still start.
    if (error != 0) contained = Containment::kSubreaper;
    child.dies_with_us = false;
  }
  if (error != 0) error = start(child, 0, pid);
  ::pthread_sigmask(SIG_SETMASK, &child.mask, nullptr);
  if (error != 0)
    throw failure_of(request.arguments[request.keeper_line >= 0 ? 1 : 0] + ": cannot be started",
                     error, ExitCode::kEngine);
  return {pid, child.writes_limited, contained};
}

}  // namespace lobelia
