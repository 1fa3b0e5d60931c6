// What this machine can hold an engine to.
#pragma once

#include <vector>

#include "farm/slurm/doctor.hpp"

namespace lobelia {

/// Tries what contains an engine's processes, its writing and its memory. What does not work here is a warning: a
/// farm works without it.
std::vector<DoctorCheck> look_at_machine();

}  // namespace lobelia
