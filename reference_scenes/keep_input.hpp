// An engine's input files, to look at or to render without Lobelia.
#pragma once

#include <filesystem>
#include <string_view>

#include "reference_scenes/engine.hpp"

namespace lobelia {

/// Writes the input files and a script with the command that renders them into `directory`; of a scene
/// that is an average of many, each into a directory setR-P of its own: the mean over P is one estimate.
void keep_engine_input(std::string_view engine, const Scene& scene, const ReferenceOptions& options,
                       const std::filesystem::path& directory);

}  // namespace lobelia
