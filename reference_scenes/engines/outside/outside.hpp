// Engines of the user's own: a program that gets a cell's scene and writes a picture, or pictures that exist already.
// docs/own_engine.md is the user's view.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/records/outside_engine.hpp"
#include "base/system/leave.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia {

using records::OutsideEngine;

/// Its status() runs `version_command`, and a session runs `command` for each picture: without a shell, contained as every
/// engine. `leave` is that of the files that name it; without leave for its own file too, nothing is started, and pictures
/// that lie elsewhere are Error(kUsage). A picture file that does not exist is a refusal that begins with kMissingPicture.
std::unique_ptr<Engine> make_outside_engine(const OutsideEngine& engine, const Leave& leave);
inline constexpr std::string_view kMissingPicture = "missing: ";

/// Writes the cell's scene and a script with its command into `directory`; nothing for pictures that exist.
void keep_outside_input(const OutsideEngine& engine, const Scene& scene, const AxisValues& axes,
                        const std::filesystem::path& directory);

/// Lists what the engine starts, for refuse_without_leave(): "start 'sh mine.sh' by engine mine". Nothing for pictures.
std::vector<std::string> starts_of(const OutsideEngine& engine);

/// Throws Error(kUsage), with all that would be started without leave. `leave` is that of the file that names the engines.
void require_leave_to_start(std::span<const OutsideEngine> engines, const Leave& leave);

}  // namespace lobelia
