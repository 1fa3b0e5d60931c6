// A scene written down for render_scenes.py: numbers and enumerations. Nothing that a user typed into the scene file (ids,
// paths) gets in, so none of it can become code.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference_scenes/persistent_session.hpp"

namespace lobelia {

inline constexpr char kBlenderJobFile[] = "job.json";

/// Whether Cycles' own closure can shade all highlights.
bool is_native_in_blender(const Scene& scene);

/// Its text is one entry of the job's "scenes". `scene` is in engine units (preparation.hpp); `native` requires is_native_in_blender. Throws Error(kEngine) for what
/// Blender cannot render.
SceneInput blender_input(const Scene& scene, const std::string& name, bool native = false);

/// Why Cycles' own light transport cannot show a scene, as a sentence; empty if it can.
std::string why_not_for_cycles_transport(const Scene& scene);
SceneInput cycles_transport_input(const Scene& scene, const std::string& name);
/// The file with the sky's picture, beside the job.
std::string sky_file(const std::string& scene);

/// The job that a process starts with. With `go_on` it asks for more scenes afterwards.
std::string blender_job(int threads, const ReferenceOptions& options, const SceneInput& scene,
                        bool go_on);

/// Runs render_scenes.py without the user's start-up file and add-ons; failures in Python end Blender. `directory` holds
/// scripts and job. It is spelled out because Blender trusts $PWD more than its working directory.
std::vector<std::string> blender_arguments(const std::string& program,
                                           const std::filesystem::path& directory);
/// Writes render_scenes.py and the modules that it imports.
void write_blender_scripts(const std::filesystem::path& directory);

}  // namespace lobelia
