// Grid files from the text of their elements.
#pragma once

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "farm/grid.hpp"
#include "lobelia_paths.hpp"
#include "tests/test.hpp"

namespace lobelia {

/// By a link, because a file's name on an axis ends at a blank and the source's directory may have one.
inline std::string scene_files() {
  static const TemporaryDirectory directory;
  const auto link = directory.path() / "scenes";
  if (!std::filesystem::exists(link))
    std::filesystem::create_symlink(std::string(LOBELIA_SOURCE_DIR) + "/reference_scenes/scenes",
                                    link);
  return link.string() + "/";
}
inline const std::string kSceneFiles = scene_files();
inline const std::string kScene = "<scene file=\"" + kSceneFiles + "head_on.xml\"/>";

/// `attributes` are of the root, with a blank in front.
inline Grid grid_of(const std::string& body, const std::string& attributes = "") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "g.xml";
  write_file(path, "<grid version=\"1\"" + attributes + ">" + body + "</grid>");
  return read_grid(path);
}

inline std::string error_of(const std::string& body, const std::string& attributes = "") {
  try {
    grid_of(body, attributes);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    return error.what();
  }
  return "it was read";
}

inline std::string axis(const std::string& name, const std::string& values) {
  return "<axis name=\"" + name + "\" values=\"" + values + "\"/>";
}

/// "1 2 3", so many.
inline std::string numbers(int count) {
  std::string text;
  for (int i = 1; i <= count; ++i) text += std::to_string(i) + " ";
  return text;
}

}  // namespace lobelia
