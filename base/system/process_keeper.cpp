// lobelia_process_keeper PROGRAM ARGUMENTS...: runs a program, and ends once the program and all of its descendants have
// ended. Started by base/system/process.cpp, as process 1 of a PID namespace where the kernel allows it.
#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/system/keeper_protocol.hpp"

namespace {

using lobelia::KeeperReport;
using lobelia::kKeeperLine;

struct Signals {
  sigset_t mask;
  struct sigaction child, terminate;
};

/// Returns 0, or the errno if the program cannot be started.
int start(char** arguments, const Signals& before, pid_t& pid) {
  volatile int error = 0;  // written by the child, which shares our memory until execv()
  pid = ::vfork();
  if (pid == 0) {
    ::setpgid(0, 0);  // so that signals to its group do not reach us
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::sigaction(SIGCHLD, &before.child, nullptr);
    ::sigaction(SIGTERM, &before.terminate, nullptr);
    ::sigprocmask(SIG_SETMASK, &before.mask, nullptr);
    ::execv(arguments[0], arguments);
    error = errno;
    ::_exit(127);
  }
  if (pid < 0) error = errno;
  if (pid > 0 && error != 0) ::waitpid(pid, nullptr, 0);
  return error;
}

/// The parent of a process, by /proc/PID/stat: "123 (name) S 100 ..."; 0 if it is gone.
pid_t parent_of(const char* process) {
  char path[300], text[512];
  std::snprintf(path, sizeof path, "/proc/%s/stat", process);
  std::FILE* file = std::fopen(path, "re");
  if (!file) return 0;
  const std::size_t size = std::fread(text, 1, sizeof text - 1, file);
  std::fclose(file);
  text[size] = '\0';
  int parent = 0;
  const char* name_end = std::strrchr(text, ')');
  return name_end && std::sscanf(name_end, ") %*c %d", &parent) == 1 ? parent : 0;
}

/// Kills all our children. As a subreaper we inherit every descendant that loses its parent. Returns how many.
int kill_children() {
  DIR* processes = ::opendir("/proc");
  if (!processes) return 0;
  const pid_t self = ::getpid();
  int killed = 0;
  while (const dirent* entry = ::readdir(processes)) {
    const int pid = std::atoi(entry->d_name);
    // The PID cannot be reused before we have waited for it.
    if (pid > 0 && parent_of(entry->d_name) == self && ::kill(pid, SIGKILL) == 0) ++killed;
  }
  ::closedir(processes);
  return killed;
}

/// Reaps children that have ended; waits for one if `flags` is 0. False if there is no child.
bool reap(pid_t program, int flags, int& status, bool& ended) {
  for (;;) {
    int one = 0;
    const pid_t pid = ::waitpid(-1, &one, flags);
    if (pid < 0) return errno != ECHILD;
    if (pid == 0) return true;
    if (pid == program) {
      status = one;
      ended = true;
    }
    flags = WNOHANG;
  }
}

/// Waits until the program has ended, our parent wants an end, or our parent is gone.
void wait_for_end(pid_t program, int signals, int& status) {
  for (bool ended = false; !ended;) {
    pollfd waits[] = {{signals, POLLIN, 0}, {kKeeperLine, POLLIN | POLLRDHUP, 0}};
    ::poll(waits, 2, -1);
    if (waits[1].revents != 0) return;
    signalfd_siginfo signal;
    while (::read(signals, &signal, sizeof signal) > 0)
      if (signal.ssi_signo == SIGTERM) return;
    reap(program, WNOHANG, status, ended);
  }
}

void end_all(pid_t program, int& status) {
  bool ignored = false;
  int killed = 0;
  do {
    // Process 1 kills the whole namespace at once. Otherwise in rounds: grandchildren become our children when their
    // parents die.
    killed = ::getpid() == 1 ? (::kill(-1, SIGKILL) == 0 ? 1 : 0) : kill_children();
  } while (reap(program, killed > 0 ? 0 : WNOHANG, status, ignored));
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) return 1;
  ::close_range(kKeeperLine + 1, ~0u, 0);
  ::fcntl(kKeeperLine, F_SETFD, FD_CLOEXEC);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);  // we could not kill a set-user-ID program
  Signals before;
  struct sigaction by_default {};
  by_default.sa_handler = SIG_DFL;
  ::sigaction(SIGCHLD, &by_default, &before.child);
  ::sigaction(SIGTERM, &by_default, &before.terminate);
  sigset_t all, waking;
  ::sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, &before.mask);
  ::sigemptyset(&waking);
  ::sigaddset(&waking, SIGCHLD);
  ::sigaddset(&waking, SIGTERM);
  const int signals = ::signalfd(-1, &waking, SFD_CLOEXEC | SFD_NONBLOCK);

  KeeperReport report;
  pid_t program = 0;
  report.start_error = signals < 0 ? errno : start(arguments + 1, before, program);
  for (int i = 0; i < 3; ++i) ::close(i);  // so that their readers see when the program closes them
  ::send(kKeeperLine, &report, sizeof report, MSG_NOSIGNAL);
  if (report.start_error != 0) return 1;
  wait_for_end(program, signals, report.status);
  end_all(program, report.status);
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  report.cpu_microseconds = 1'000'000LL * (used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                            used.ru_utime.tv_usec + used.ru_stime.tv_usec;
  report.peak_kibibytes = used.ru_maxrss;
  ::send(kKeeperLine, &report, sizeof report, MSG_NOSIGNAL);
  return 0;
}
