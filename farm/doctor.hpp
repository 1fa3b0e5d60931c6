// A check of this machine before the first grid.
#pragma once

#include <string>

namespace lobelia {

/// Tries the limits for engines on this machine: their processes, writing and memory. A line each, "ok" or "warning" first,
/// and below a warning what to do.
std::string doctor_text();

}  // namespace lobelia
