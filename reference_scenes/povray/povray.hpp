// POV-Ray as a reference engine.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

inline constexpr EngineInfo kPovrayInfo{"povray", "POV-Ray", "sudo apt-get install povray"};

std::unique_ptr<Engine> make_povray(const std::filesystem::path& program);

/// Writes what POV-Ray is given for `scene` into `directory`, which exists.
void keep_povray_input(const Scene& scene, const std::filesystem::path& directory);

}  // namespace lobelia
