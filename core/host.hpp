// Which machine a result was made on.
#pragma once

#include <string>

namespace lobelia {

/// "Intel(R) Xeon(R) Processor"; "unknown" if the system does not tell.
std::string processor_name();

/// As the system calls it: "node17". Empty if it does not tell.
std::string host_name();

/// Whether a process has the number in /proc that we know it by: not in a PID namespace without a /proc of its own.
bool proc_has_our_numbers();

}  // namespace lobelia
