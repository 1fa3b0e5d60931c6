#include "reference_scenes/formats/mitsuba.hpp"

#include <string>

#include "renderer/scene/scene_io.hpp"
#include "tests/fuzz/checks.hpp"
#include "tests/fuzz/same_scene.hpp"

namespace lobelia::fuzz {

void check_mitsuba_reader(std::string_view text) {
  Scene scene;
  try {
    // Without a directory, so that no file can be read.
    scene = parse_mitsuba(std::string(text), "scene.xml").scene;
  } catch (const Error& error) {
    return check_refusal(error);
  }
  const std::string written = scene_to_xml(scene);
  try {
    if (same_scene(scene, parse_scene(written, "ours.xml"))) return;
  } catch (const Error& error) {
    throw std::logic_error(error.what() + ("\nwas read as:\n" + written));
  }
  throw std::logic_error("what was read is written as another scene:\n" + written);
}

}  // namespace lobelia::fuzz
