// Scene files: XML in the spirit of Mitsuba's. docs/scene_format.md lists elements and parameters.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Reads and checks a scene. Throws Error(kInput) whose message has one line per error found, each
/// "file:line:column: what, the value, what is allowed".
Scene read_scene(const std::filesystem::path& path);
/// The same from memory; `file_name` stands in the messages. Pictures that the scene names are looked
/// for in `directory`; without one they are an error, and no file is touched.
Scene parse_scene(std::string text, const std::string& file_name,
                  const std::filesystem::path& directory = {});

/// A scene file that reads back to the same scene, number for number, in the directory that its
/// pictures were found in.
std::string scene_to_xml(const Scene& scene);

}  // namespace lobelia
