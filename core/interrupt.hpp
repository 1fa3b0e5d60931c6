// Ctrl-C: a flag that long work looks at between steps.
#pragma once

namespace lobelia {

/// Makes SIGINT and SIGTERM set the flag. A second SIGINT ends the process at once.
void catch_interrupts();
/// True once the user has asked to stop.
bool interrupted();
/// Throws Error(kInterrupted) if interrupted().
void throw_if_interrupted();

}  // namespace lobelia
