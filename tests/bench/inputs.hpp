// Scenes, grids and commands that several benchmarks measure.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/process.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::bench {

/// The file of a canonical scene.
std::string scene_file(std::string_view name);

/// How large a crowd's spheres are.
enum class CrowdKind {
  kPacked,  ///< 0.4 of their spacing: a ray soon meets one, so its cost may grow as the logarithm of their number
  kThin,  ///< a ray through all meets half a sphere on average, and passes the cube root of their number
};
/// Spheres in a jittered lattice of columns, rows and layers, all in the same cube.
Scene crowd(CrowdKind kind, const std::array<int, 3>& lattice, int side);

/// A grid of the models that are not microfacets, two lobes and so many exponents: ten cells for each exponent.
std::string grid_of_models(int exponents, std::string_view more_axes = "");

/// Runs a command without showing its output. Throws std::runtime_error if it fails.
ProcessResult run(const std::vector<std::string>& command);
/// lobelia render of a canonical scene: its command, and running it.
std::vector<std::string> render_command(const std::string& program, std::string_view scene,
                                        int width, int height, const std::filesystem::path& to);
ProcessResult render_file(const std::string& program, std::string_view scene, int width, int height,
                          const std::filesystem::path& to);
/// Renders to an EXR and a PNG of that name.
void render_both_files(const std::string& program, std::string_view scene, int width, int height,
                       std::filesystem::path to);
/// lobelia compare with a limit that always holds, so that the exit code is 0: its command, and running it.
std::vector<std::string> comparison(const std::string& program, const std::filesystem::path& a,
                                    const std::filesystem::path& b,
                                    const std::vector<std::string>& more);
ProcessResult compare(const std::string& program, const std::filesystem::path& a,
                      const std::filesystem::path& b, const std::vector<std::string>& more);

}  // namespace lobelia::bench
