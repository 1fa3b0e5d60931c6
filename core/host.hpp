// Which machine a result was made on.
#pragma once

#include <string>

#include "core/record.hpp"

namespace lobelia {

/// As the system calls it: "node17". Empty if it does not tell.
std::string host_name();

/// Whether a process has the number in /proc that we know it by: not in a PID namespace without a /proc of its own.
bool proc_has_our_numbers();

/// {"processor": ..., "threads": ..., "system": ...}
Json host_record();

}  // namespace lobelia
