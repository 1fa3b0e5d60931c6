#include "core/spawn.hpp"

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

#include "core/error.hpp"
#include "core/no_resources.hpp"

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
  int input, output, line;        // -1: /dev/null, -, none
  int ruleset;                    // -1: none
  std::uint64_t keep;             // bit i: leave signal i + 1 as it is
  rlimit largest_file;            // where it is not 0
  // Of a user namespace that is to have our user and group and no others; null: none.
  const char *user_map = nullptr, *group_map = nullptr;
  std::size_t user_map_size = 0, group_map_size = 0;
  bool dies_with_us = false;
  sigset_t mask;
  bool writes_limited = false;
  int error = 0;
};

constexpr int kFirstFreeDescriptor = 10;  // beyond all that a program is given

/// Like become(), of which it is a part.
__attribute__((noinline, no_sanitize("address", "thread", "undefined"))) bool write_text(
    const char* file, const char* text, std::size_t size) {
  const int descriptor = int(::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CLOEXEC, 0));
  return descriptor >= 0 && ::syscall(SYS_write, descriptor, text, size) == long(size) &&
         ::syscall(SYS_close, descriptor) == 0;
}

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
  // The kernel takes a group's map only from who cannot drop groups.
  if (ready && child.user_map)
    ready = write_text("/proc/self/setgroups", "deny", 4) &&
            write_text("/proc/self/uid_map", child.user_map, child.user_map_size) &&
            write_text("/proc/self/gid_map", child.group_map, child.group_map_size);
  int input = child.input;
  if (ready && input < 0)
    ready =
        (input = int(::syscall(SYS_openat, AT_FDCWD, "/dev/null", O_RDONLY | O_CLOEXEC, 0))) >= 0;
  int descriptors[4] = {input, child.output, child.output, child.line};
  const int wanted = child.line >= 0 ? 4 : 3;
  int ruleset = child.ruleset;
  if (ready && ruleset >= 0 && ruleset < wanted)  // another one comes to be in its place
    ready =
        (ruleset = int(::syscall(SYS_fcntl, ruleset, F_DUPFD_CLOEXEC, kFirstFreeDescriptor))) >= 0;
  for (int i = 0; i < wanted; ++i)  // out of the way of those that come before it
    if (ready && descriptors[i] != i && descriptors[i] < wanted)
      ready = (descriptors[i] = int(::syscall(SYS_fcntl, descriptors[i], F_DUPFD_CLOEXEC,
                                              kFirstFreeDescriptor))) >= 0;
  for (int i = 0; i < wanted; ++i)  // one that is in its place already only has to stay open
    ready = ready && (descriptors[i] == i ? ::syscall(SYS_fcntl, i, F_SETFD, 0)
                                          : ::syscall(SYS_dup3, descriptors[i], i, 0)) >= 0;
  if (ready && child.working_directory) ready = ::syscall(SYS_chdir, child.working_directory) == 0;
  // If we have died before that, the keeper finds its line closed.
  if (ready && child.dies_with_us)
    ready = ::syscall(SYS_prctl, PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0) == 0;
  if (ready && child.largest_file.rlim_cur > 0)
    ready = ::syscall(SYS_prlimit64, 0, RLIMIT_FSIZE, &child.largest_file, nullptr) == 0;
  // Without root's rights the kernel wants to be sure that no set-user-ID program is misled.
  if (ready && ruleset >= 0)
    ready = child.writes_limited = ::syscall(SYS_prctl, PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                                   ::syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
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

/// clone(2) with these namespaces, up to where the child is its program. Returns 0 or an errno.
int start(Child& child, unsigned long namespaces, pid_t& pid) {
  alignas(16) std::array<std::byte, 16384> stack;
  child.error = 0;
  // posix_spawn does the same, but has no word for namespaces, PR_SET_PDEATHSIG and Landlock.
  pid = plain_clone(become, stack.data() + stack.size(),
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
              .keep = ignored_signals(),
              .largest_file = {request.largest_file, request.largest_file},
              .mask = {}};
  // Else a file that is too large would be an error like any other.
  if (request.largest_file > 0) child.keep &= ~(std::uint64_t{1} << (SIGXFSZ - 1));
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
    // Whatever there is against a namespace is nothing against the program.
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
