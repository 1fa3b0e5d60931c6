// Hashes of files that may be large or on a slow disk.
#pragma once

#include <chrono>
#include <limits>

#include "core/sha256.hpp"

namespace lobelia {

/// No limit on the time of a hash.
inline constexpr std::chrono::duration<double> kAnyTime{std::numeric_limits<double>::infinity()};

/// sha256_of_file(). Throws Error(kInput) also if that takes longer than `time_limit`.
Sha256Digest sha256_of_file(const InputFile& file, std::chrono::duration<double> time_limit);

}  // namespace lobelia
