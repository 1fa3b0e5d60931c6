// Opening a file by a name that a stranger has chosen, without leaving a directory.
#pragma once

#include <string>
#include <vector>

namespace lobelia {

/// Opens what `names` lead to below the open `directory`, for reading, and never waits for a pipe's writer. A link is
/// followed only where it stays below `directory`, whatever happens to the path meanwhile. Each name is one of a
/// directory's: no separator, not "..". The descriptor is the caller's; -1 with errno where there is none.
int open_beneath(int directory, const std::vector<std::string>& names);

/// What open_beneath() does on a kernel without openat2 (before Linux 5.6): the same, but follows no link at all.
int open_beneath_by_steps(int directory, const std::vector<std::string>& names);

}  // namespace lobelia
