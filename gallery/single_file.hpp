// A site as one file that can be sent.
#pragma once

#include <filesystem>
#include <string>

namespace lobelia::gallery {

/// The site of write_report() in `directory` as one page: its style and script, and every page, picture and value, which
/// the script opens by their names. Needs no file beside it and no network, but a script. Throws Error(kInput) if a file
/// of the site cannot be read.
std::string single_file(const std::filesystem::path& directory, const std::string& title);

}  // namespace lobelia::gallery
