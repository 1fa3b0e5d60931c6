// Forms of a scene for other programs. To add one: write its file in this folder (or in its engine's), declare it
// below, and add it to the list in catalogue.cpp.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "base/records/scene.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// A form of a scene for other programs.
struct SceneFormat {
  std::string_view name;     ///< "mitsuba", as on the command line
  std::string_view title;    ///< "Mitsuba 3"
  std::string_view file;     ///< name of the main file, "scene.xml"
  std::string_view meaning;  ///< for the help and the docs
  /// Why the scene cannot be said in it, as a sentence; empty if it can.
  std::string (*why_not)(const Scene& scene);
  /// Texts by file name, the main file among them. The scene has passed why_not().
  std::map<std::string, std::string> (*write)(const Scene& scene);
};

/// In the order of the help.
std::span<const SceneFormat> scene_formats();
/// Throws Error(kUsage), with the nearest name.
const SceneFormat& scene_format(std::string_view name);

// The formats, each in a file of its own, and what several of them need.

extern const SceneFormat kJsonFormat, kMitsubaFormat, kPovrayFormat, kBlenderPythonFormat;

/// The most spheres that are written out one by one. Our own reader takes at most kMaxSceneBytes.
inline constexpr std::size_t kMaxWrittenSpheres = 200'000;
/// Why a scene with so many spheres is not written; empty if it is.
std::string why_not_so_many_spheres(const Scene& scene);
/// The same, or why a format that spells out each type of light does not know one of the scene's.
std::string why_not_spelled_out(const Scene& scene);

/// The scene as numbers.
records::Scene scene_record(const Scene& scene);

}  // namespace lobelia
