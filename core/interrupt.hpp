// Ctrl-C: a flag that long work looks at between steps, and an end for work that does not look.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string_view>

#include "core/error.hpp"

namespace lobelia {

/// Makes SIGINT, SIGTERM and SIGHUP set the flag. A second one, 0.3 s later or more, ends the process at
/// once, and the processes that are registered with it.
void catch_interrupts();
/// From now on the first signal ends a process that has not ended by itself after 0.25 s, whatever it is
/// doing: registered processes are ended, temporary files and directories are removed, one line goes to
/// stderr, and the exit code is interrupt_exit_code(). Asked once, after catch_interrupts().
void end_soon_when_interrupted();
/// Takes that back, for work that needs longer to stop in good order.
void end_by_ourselves_when_interrupted();
/// True once the user has asked to stop.
bool interrupted();
/// 128 + the number of the first signal: kInterrupted, kTerminated or kHungUp.
ExitCode interrupt_exit_code();
/// Throws Error(kInterrupted) if interrupted().
void throw_if_interrupted();

/// The results are out: the exit code is theirs, even if a signal comes now.
void interrupts_come_too_late();
/// Interrupted before that, in a process that is to end soon.
bool interrupted_in_time();

/// The calling thread is about to end the process, and nothing else does so any more, but a second Ctrl-C.
void take_over_end();

/// While one lives, end_soon_when_interrupted() does not end the process. For short steps.
class EndDelay {
 public:
  EndDelay();
  ~EndDelay();
  EndDelay(const EndDelay&) = delete;
  EndDelay& operator=(const EndDelay&) = delete;
};

/// A temporary file or directory that end_soon_when_interrupted() removes while this object lives.
class TemporaryPath {
 public:
  /// `create` makes it and returns its path; what it throws is passed on.
  explicit TemporaryPath(const std::function<std::filesystem::path()>& create);
  ~TemporaryPath();
  TemporaryPath(TemporaryPath&& other) noexcept;
  TemporaryPath& operator=(TemporaryPath&&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// It is gone, or has its final name.
  void forget();

 private:
  std::filesystem::path path_;  ///< empty once forgotten
};

/// Sets the text that a second Ctrl-C writes to stderr before it ends the process; at most 1000 bytes. It says where
/// work goes on without this process. Not for several threads at once.
void set_last_words(std::string_view text);

/// Holds a keeper (core/process_keeper.cpp) where a second Ctrl-C finds it, for as long as this object lives: SIGTERM makes
/// it end all that it keeps.
class InterruptibleProcess {
 public:
  explicit InterruptibleProcess(pid_t keeper);
  ~InterruptibleProcess();
  InterruptibleProcess(const InterruptibleProcess&) = delete;
  InterruptibleProcess& operator=(const InterruptibleProcess&) = delete;

 private:
  int slot_ = -1;
};

}  // namespace lobelia
