// Scene files for tests of the reader: a frame around what a test is about, and the error of one.
#pragma once

#include "base/system/error.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/fuzz/same_scene.hpp"
#include "tests/test.hpp"

namespace lobelia {

inline constexpr char kSensor[] =
    "<sensor type=\"perspective\"><float name=\"fov\" value=\"28\"/>"
    "<transform name=\"to_world\"><lookat origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/>"
    "</transform></sensor>";
inline constexpr char kMaterial[] =
    "<bsdf type=\"phong_rdf\" id=\"m\"><float name=\"exponent\" value=\"8\"/></bsdf>";

/// The first line of `body` is line 3.
inline std::string scene(const std::string& body, const std::string& sensor = kSensor) {
  return "<scene version=\"1\">\n" + sensor + "\n" + body + "\n</scene>";
}

/// A sensor of that type with `more` in it.
inline std::string sensor(const std::string& type, const std::string& more) {
  std::string text = kSensor;
  text.replace(text.find("perspective"), 11, type);
  return text.insert(text.find("</sensor>"), more);
}

/// A parameter as it stands in a file.
inline std::string given(const std::string& tag, const std::string& name,
                         const std::string& value) {
  return "<" + tag + " name=\"" + name + "\" value=\"" + value + "\"/>";
}

inline std::string error_of(const std::string& text, const std::filesystem::path& directory = {}) {
  try {
    parse_scene(text, "s.xml", directory);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    return error.what();
  }
  return "it was read";
}

/// The scene written down and read again; scene and text must be the same.
inline Scene again(const Scene& scene, const std::filesystem::path& directory = {}) {
  const std::string xml = scene_to_xml(scene);
  Scene back = parse_scene(xml, "again.xml", directory);
  EXPECT_EQ(scene_to_xml(back), xml);
  EXPECT_TRUE(fuzz::same_scene(scene, back)) << xml;
  return back;
}

struct BadScene {
  std::string text, message;  ///< the message word for word
};

}  // namespace lobelia
