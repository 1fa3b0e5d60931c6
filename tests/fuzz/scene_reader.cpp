#include "tests/fuzz/checks.hpp"

#include <optional>
#include <string>

#include "renderer/scene/scene_io.hpp"
#include "tests/fuzz/same_scene.hpp"

namespace lobelia::fuzz {
namespace {

/// A lattice of more spheres is not written: it would find nothing more and take the time of a thousand other inputs.
constexpr std::size_t kMaxWrittenSpheres = 1000;

/// Without a directory, so that no file can be read.
std::optional<Scene> read(std::string_view text) {
  try {
    return parse_scene(std::string(text), "scene.xml");
  } catch (const Error& error) {
    check_refusal(error);
    return std::nullopt;
  }
}

}  // namespace

void check_scene_reader(std::string_view text) {
  const auto scene = read(text);
  if (!scene || scene->spheres.size() > kMaxWrittenSpheres) return;
  const std::string written = scene_to_xml(*scene);
  const auto again = read(written);
  if (!again) throw std::logic_error("what was written cannot be read:\n" + written);
  if (const std::string second = scene_to_xml(*again); second != written)
    throw std::logic_error("what was written is written again as:\n" + written + "\n" + second);
  if (!same_scene(*scene, *again))
    throw std::logic_error("what was written reads as another scene:\n" + written);
}

}  // namespace lobelia::fuzz
