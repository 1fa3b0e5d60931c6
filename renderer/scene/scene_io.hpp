// Scene files: XML in the spirit of Mitsuba's. docs/scene_format.md lists elements and parameters.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Reads and checks a scene. Throws Error(kInput) with one line for each error found: "file:line:column: what is
/// wrong, the value, what is allowed".
Scene read_scene(const std::filesystem::path& path);
/// The same from memory, with `file_name` in the messages. Reads the scene's pictures from `directory`; without one
/// they are an error, and no file is touched.
Scene parse_scene(std::string text, const std::string& file_name,
                  const std::filesystem::path& directory = {});

/// A scene file that reads back to the same scene, number for number, in the directory of its pictures.
std::string scene_to_xml(const Scene& scene);

}  // namespace lobelia
