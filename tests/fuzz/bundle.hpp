// Several files in one input of a fuzzer.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "base/system/files.hpp"

namespace lobelia::fuzz {

/// A line "=== NAME" begins a file, unless the name is hidden, a path or over 40 bytes. Text before the first is dropped.
std::map<std::string, std::string> files_of_bundle(std::string_view bundle);

/// A directory for files, the same for each input. Each check empties its part.
const std::filesystem::path& scratch();

/// Unlike write_file() does not wait for the disk.
void write_plainly(const std::filesystem::path& path, std::string_view text);

}  // namespace lobelia::fuzz
