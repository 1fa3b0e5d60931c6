// A site as one file that can be sent.
#pragma once

#include <filesystem>
#include <string>

namespace lobelia::gallery {

/// In the head of every gallery in one file, by which we know it again.
inline constexpr char kSingleFileMark[] = "Lobelia, a gallery in one file";

/// The site in `directory` as one page: its style and script, and every page, picture and value, which the script opens by
/// their names. Needs no file beside it and no network, but a script. Opens at `first_page` and has no other page then;
/// empty: at its index. Throws Error(kInput) if a file of the site cannot be read.
std::string single_file(const std::filesystem::path& directory, const std::string& title,
                        const std::string& first_page = "");

}  // namespace lobelia::gallery
