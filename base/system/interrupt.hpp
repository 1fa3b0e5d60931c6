// Ctrl-C: a flag for long work to look at, and a watcher that ends work that does not look.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string_view>

#include "base/system/error.hpp"

namespace lobelia {

/// Makes SIGINT, SIGTERM and SIGHUP set the flag. A second signal, at least 0.3 s later, ends this process and the
/// registered ones at once.
void catch_interrupts();
/// Makes the first signal end this process if it has not ended by itself after 0.25 s: registered processes are ended,
/// temporary files and directories removed, one line is written to stderr, and the exit code is interrupt_exit_code().
/// Call it once, after catch_interrupts().
void end_soon_when_interrupted();
/// Undoes end_soon_when_interrupted(), for work that needs longer to stop in good order.
void end_by_ourselves_when_interrupted();
/// True once the user has asked to stop.
bool interrupted();
/// Asks to stop, as Ctrl-C does: for a program that catches signals itself.
void request_interrupt();
/// Takes it back once that work has stopped.
void forget_interrupt();
/// Asks to stop once this time is over; interrupt_exit_code() is kTimedOut then.
void end_after(double seconds);
/// 128 + the number of the first signal: kInterrupted, kTerminated or kHungUp; or kTimedOut.
ExitCode interrupt_exit_code();
/// "interrupted", or that the time limit is over.
std::string_view interrupt_reason();
/// Throws Error(kInterrupted) if interrupted(), unless the thread has an Uninterrupted.
void throw_if_interrupted();

/// While this lives, throw_if_interrupted() throws nothing on its thread: for what is to be completed after an
/// interruption too.
class Uninterrupted {
 public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
};

/// Says that the results are written: they decide the exit code, even if a signal comes now.
void interrupts_come_too_late();
/// Whether a signal came before that, in a process that ends soon.
bool interrupted_in_time();

/// Leaves the end of the process to the calling thread: only a second Ctrl-C can still end it otherwise.
void take_over_end();

/// Keeps end_soon_when_interrupted() from ending the process while this lives. For short steps.
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
  /// `create` makes it and returns its path.
  explicit TemporaryPath(const std::function<std::filesystem::path()>& create);
  ~TemporaryPath();
  TemporaryPath(TemporaryPath&& other) noexcept;
  TemporaryPath& operator=(TemporaryPath&&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// For one that is gone or has its final name.
  void forget();

 private:
  std::filesystem::path path_;  ///< empty once forgotten
};

/// Sets the text that a second Ctrl-C writes to stderr, at most 1000 bytes: where work goes on without this process. Not
/// for several threads at once.
void set_last_words(std::string_view text);

/// Registers a keeper (base/system/process_keeper.cpp) while this lives: a second Ctrl-C sends it SIGTERM, and it ends
/// all that it keeps.
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
