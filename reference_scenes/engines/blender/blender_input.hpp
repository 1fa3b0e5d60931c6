// A scene written down for render_scenes.py: numbers and enumerations. Nothing that a person typed
// into the scene file (ids, paths) is in it, so nothing of it can become code.
#pragma once

#include <string>

#include "reference_scenes/engine.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Whether Cycles' own closure has all highlights.
bool is_native_in_blender(const Scene& scene);

/// One entry of the job's "scenes".
struct BlenderScene {
  std::string name;
  std::size_t passes = 0;  ///< pictures that it makes
  std::string json;        ///< in one line
};

/// `scene` is in engine units (preparation.hpp); `name` is ours; `native` is
/// for scenes of which is_native_in_blender. Throws Error(kEngine) for what Blender cannot render.
BlenderScene blender_input(const Scene& scene, const std::string& name, bool native = false);

/// Why Cycles' own light transport cannot show a scene, as a sentence; empty if it can.
std::string why_not_for_cycles_transport(const Scene& scene);
BlenderScene cycles_transport_input(const Scene& scene, const std::string& name);
/// The file of the sky's picture, beside the job.
std::string sky_file(const std::string& scene);

/// The job that a process starts with. With `go_on` it asks for further scenes.
std::string blender_job(int threads, const ReferenceOptions& options, const BlenderScene& scene,
                        bool go_on);

}  // namespace lobelia
