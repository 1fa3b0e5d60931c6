// Engines of the user's own: a program that gets a cell's scene and writes a picture, or pictures that exist already.
// docs/own_engine.md is the user's view.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "records/outside_engine.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/outside/command_text.hpp"

namespace lobelia {

using records::OutsideEngine;

/// Its status() runs `version_command`, and a session runs `command` for each picture: without a shell, contained as every
/// engine. A picture file that does not exist is a refusal that begins with kMissingPicture.
std::unique_ptr<Engine> make_outside_engine(const OutsideEngine& engine);
inline constexpr std::string_view kMissingPicture = "missing: ";

/// Writes the cell's scene and a script with its command into `directory`; nothing for pictures that exist.
void keep_outside_input(const OutsideEngine& engine, const Scene& scene, const AxisValues& axes,
                        const std::filesystem::path& directory);

/// Throws Error(kUsage), with all that would be started, unless `allowed` or the file that describes each program lies in a
/// directory named in $LOBELIA_ALLOW_COMMANDS_IN, a list with colons.
void require_commands_allowed(std::span<const OutsideEngine> engines, bool allowed);

}  // namespace lobelia
