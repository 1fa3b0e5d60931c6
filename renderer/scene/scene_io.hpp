// Scene files: XML in the spirit of Mitsuba's. docs/scene_format.md lists elements and parameters.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Reads and checks a scene. Throws Error(kInput) whose message has one line per error found, each
/// "file:line:column: what, the value, what is allowed".
Scene read_scene(const std::filesystem::path& path);
/// The same from memory; `file_name` stands in the messages.
Scene parse_scene(std::string text, const std::string& file_name);

/// A scene file that reads back to the same scene, number for number.
std::string scene_to_xml(const Scene& scene);

}  // namespace lobelia
