// What an engine is given, for someone who wants to see or render it without Lobelia.
#pragma once

#include <filesystem>
#include <string_view>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Writes the input files and a script with the command that renders them into `directory`.
void keep_engine_input(std::string_view engine, const Scene& scene,
                       const std::filesystem::path& directory);

}  // namespace lobelia
