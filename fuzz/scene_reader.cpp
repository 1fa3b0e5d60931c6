#include "fuzz/checks.hpp"

#include <optional>
#include <stdexcept>
#include <string>

#include "core/error.hpp"
#include "fuzz/same_scene.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::fuzz {
namespace {

/// A lattice is a crowd in a few bytes: writing it down would take the time of a thousand other inputs,
/// and says nothing that a small one does not.
constexpr std::size_t kMaxWrittenSpheres = 1000;

/// Without a directory, so that no file can be read.
std::optional<Scene> read(std::string_view text) {
  try {
    return parse_scene(std::string(text), "scene.xml");
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput)
      throw std::logic_error(std::string("refused as no fault of the input: ") + error.what());
    if (std::string_view(error.what()).empty()) throw std::logic_error("refused without a word");
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
