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

/// What is different between them.
struct NativeEngine {
  const EngineInfo& info;
  EngineProbe probe;
  std::string_view method;  ///< records::Reference::method
  /// The engine's own highlight with this model, lobe and exponent; none if it has no such.
  std::optional<OwnHighlight> (*own)(const Highlight&);
  /// What else it cannot show, as a sentence; empty if it can.
  std::string (*why_not)(const Scene&) = nullptr;
};

/// `engine` must outlive it.
std::unique_ptr<Engine> make_native_engine(const NativeEngine& engine,
                                           const std::filesystem::path& program);

/// Writes the program's input for `scene` into `directory`, which exists.
void keep_native_input(const NativeEngine& engine, const Scene& scene,
                       const ReferenceOptions& options, const std::filesystem::path& directory);

}  // namespace lobelia
