// The reader of Mitsuba's scene files, and the constants that it shares with the writer.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Mitsuba's phong.
inline constexpr std::string_view kMitsubaModel = "modified_phong", kMitsubaLobe = "cosine";
/// The max_depth of light that comes straight from the lights.
inline constexpr int kMitsubaDirectDepth = 2;
/// Our Gaussian's radius in standard deviations.
inline constexpr double kGaussianDeviations = 3;

/// A scene read from a file of another program.
struct ImportedScene {
  Scene scene;
  /// A line for everything in the file that the scene does not have: "file:line:column: ...".
  std::vector<std::string> problems;
};

/// Reads the part of Mitsuba's format that Lobelia can show, of version 3 and of versions 0.x, which write names as
/// `specularReflectance`. Pictures are read from `directory`; without one there are none.
///
/// A light or shape with a problem is left out; any other value that cannot be read is Mitsuba's default. Throws
/// Error(kInput) with all problems if the file is no XML, or if no camera or nothing to see remains.
ImportedScene parse_mitsuba(std::string text, const std::string& file_name,
                            const std::filesystem::path& directory = {});

}  // namespace lobelia
