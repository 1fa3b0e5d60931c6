// Opens a file by an untrusted name, without leaving a directory.
#pragma once

#include <string>
#include <vector>

namespace lobelia {

/// Opens the file of the path `names` below the open `directory` for reading, without waiting for a pipe's writer. Follows
/// a link only if it stays below `directory`, even if the path changes meanwhile. No name may have a separator or be
/// "..". Returns a descriptor that the caller closes, or -1 with errno.
int open_beneath(int directory, const std::vector<std::string>& names);

/// open_beneath() for kernels without openat2 (before Linux 5.6): follows no link at all.
int open_beneath_by_steps(int directory, const std::vector<std::string>& names);

}  // namespace lobelia
