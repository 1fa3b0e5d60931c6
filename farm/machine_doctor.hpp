// Limits for engines that work on this machine.
#pragma once

#include <vector>

#include "farm/slurm/doctor.hpp"

namespace lobelia {

/// Tries what limits an engine's processes, writing and memory. What does not work is a warning: a farm works without it.
std::vector<DoctorCheck> look_at_machine();

}  // namespace lobelia
