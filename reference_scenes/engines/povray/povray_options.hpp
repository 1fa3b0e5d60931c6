// How POV-Ray is run: the options of a pass, and what it may do to files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// One line an option, "Width=64": everything that decides over the picture, because a povray.ini of
/// the system or the user is read first. Of a picture of `film`, whatever the files are called. With statistics it says how long it took.
std::vector<std::string> povray_options(const Film& film, int threads, bool statistics = false);

/// Writes `stem`.ini, with which `povray STEM.ini`, run in `directory`, renders STEM.pov to STEM.exr.
void write_povray_ini(const std::filesystem::path& directory, const std::string& stem, double gain,
                      const std::vector<std::string>& options);

/// Makes `home` a home directory in which POV-Ray `version` finds its own restrictions on and an empty
/// povray.ini: variables of the environment to run it with.
///
/// Measured with Debian's 3.7.0.10, which says that its restrictions are enabled: they keep it from
/// running programs (with the system's povray.conf changed to allow them, ours still forbids them),
/// but not from files. With [File I/O Security] restricted it writes, by #fopen and as its picture,
/// and reads, by #fopen and #include, whatever the user may. What limits its writing is
/// core/write_limit.hpp; the file is for builds that do as they say.
std::vector<std::string> povray_home(const std::filesystem::path& home, const std::string& version);

}  // namespace lobelia
