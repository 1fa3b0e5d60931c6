// Which machine a result was made on.
#pragma once

#include <string>

#include "core/record.hpp"

namespace lobelia {

/// As the system calls it: "node17". Empty if it does not tell.
std::string host_name();

/// {"processor": ..., "threads": ..., "system": ...}
Json host_record();

}  // namespace lobelia
