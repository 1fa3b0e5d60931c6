// Several files in one input of a fuzzer.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/files.hpp"

namespace lobelia::fuzz {

/// "=== NAME" on a line of its own begins a file; what comes before the first is dropped. A name that is longer than
/// 40 bytes, hidden or a path begins none.
std::map<std::string, std::string> files_of_bundle(std::string_view bundle);

/// A directory for files, the same for each input: made once, emptied by whoever uses it.
const std::filesystem::path& scratch();

/// Without core's write_file, which waits for the disk.
void write_plainly(const std::filesystem::path& path, std::string_view text);

}  // namespace lobelia::fuzz
