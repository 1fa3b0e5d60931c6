// The scenes and grids that come with the program.
#pragma once

#include <filesystem>

namespace lobelia {

/// `path`, or where there is no such file and it begins with reference_scenes/, the installed one of that name: so the
/// commands in the documentation work in any directory.
std::filesystem::path or_shipped(const std::filesystem::path& path);

}  // namespace lobelia
