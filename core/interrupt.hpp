// Ctrl-C: a flag that long work looks at between steps.
#pragma once

#include <sys/types.h>

#include <string_view>

namespace lobelia {

/// Makes SIGINT, SIGTERM and SIGHUP set the flag. A second one, 0.3 s later or more, ends the process at
/// once, and the process groups that are registered with it.
void catch_interrupts();
/// True once the user has asked to stop.
bool interrupted();
/// Throws Error(kInterrupted) if interrupted().
void throw_if_interrupted();

/// What a second Ctrl-C writes to stderr before it ends the process; at most 1000 bytes of it. Whoever holds
/// something that goes on without us says there where. One at a time; not for several threads.
void set_last_words(std::string_view text);

/// Holds a child's process group where a second Ctrl-C finds it, for as long as this object lives.
class InterruptibleGroup {
 public:
  explicit InterruptibleGroup(pid_t group);
  ~InterruptibleGroup();
  InterruptibleGroup(const InterruptibleGroup&) = delete;
  InterruptibleGroup& operator=(const InterruptibleGroup&) = delete;

 private:
  int slot_ = -1;
};

}  // namespace lobelia
