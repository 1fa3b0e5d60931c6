// Keeping another program from writing where it has no business, without any rights of our own.
#pragma once

#include <filesystem>

namespace lobelia {

/// From now on the calling thread, and every process that it starts, creates, changes and removes
/// files below `directory` only, /dev/null aside; reading stays free. It cannot be taken back, and
/// other threads are as free as before. False, and nothing limited, where the kernel has no
/// Landlock (Linux 5.13 and later, unless it was left out or is forbidden by a container).
bool limit_writes_to(const std::filesystem::path& directory);

}  // namespace lobelia
