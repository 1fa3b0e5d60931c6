// An engine that is one of our small programs around an engine's library (camera_scene.hpp, scene_program.hpp), and shades by
// the engine's own highlight or not at all.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "reference_scenes/camera_scene.hpp"
#include "reference_scenes/engine_program.hpp"

namespace lobelia {

/// The differences between these engines.
struct NativeEngine {
  EngineInfo info;
  EngineProbe probe;
  std::string_view method;  ///< records::Reference::method
  /// The engine's own highlight with this model, lobe and exponent; none if it has no such.
  std::optional<OwnHighlight> (*own)(const Highlight&);
  /// Why it cannot show the scene for other reasons, as a sentence; empty if it can.
  std::string (*why_not)(const Scene&) = nullptr;
};

// One file each, in the folder of its name.
extern const NativeEngine kTachyon, kSunflow, kThree, kBabylon, kOpengl;

/// For an engine that is given points: the cosine is the product of two vectors of three components in float32; power
/// and colour round some more.
inline constexpr EngineFloor kFloat32PointFloor{.of_peak = 8 * kFloat32Rounding,
                                                .of_cosine = 4 * kFloat32Rounding};

/// The page decides the pictures of a program in a browser, too.
inline std::vector<std::filesystem::path> page_of(const std::filesystem::path& program,
                                                  std::string_view) {
  return {program.string() + ".html"};
}

/// `engine` must outlive it.
std::unique_ptr<Engine> make_native_engine(const NativeEngine& engine,
                                           const std::filesystem::path& program);

/// Writes the program's input for `scene` into `directory`, which exists.
void keep_native_input(const NativeEngine& engine, const Scene& scene,
                       const ReferenceOptions& options, const std::filesystem::path& directory);

}  // namespace lobelia
