// What identifies a file's content.
#pragma once

#include <filesystem>
#include <string>

namespace lobelia::gallery {

/// SHA-256 (FIPS 180-4) in hexadecimal, as sha256sum prints it; empty if the file cannot be read.
std::string sha256_of(const std::filesystem::path& file);

}  // namespace lobelia::gallery
