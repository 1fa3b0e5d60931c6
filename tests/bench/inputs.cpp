#include "tests/bench/inputs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lobelia_paths.hpp"
#include "renderer/scene/sphere_lattice.hpp"

namespace lobelia::bench {

std::string scene_file(std::string_view name) {
  return fmt::format("{}/reference_scenes/scenes/{}.xml", LOBELIA_SOURCE_DIR, name);
}

Scene crowd(CrowdKind kind, const std::array<int, 3>& n, int side) {
  constexpr double kSide = 2, kShare = 0.4, kMeanHits = 0.5;
  const double count = double(n[0]) * n[1] * n[2];
  SphereLattice lattice;
  lattice.columns = n[0], lattice.rows = n[1], lattice.layers = n[2];
  lattice.step = {kSide / n[0], kSide / n[1], kSide / n[2]};
  lattice.radius =
      kSide * (kind == CrowdKind::kPacked ? kShare / std::cbrt(count)
                                          : std::sqrt(kMeanHits / (std::numbers::pi * count)));
  lattice.jitter = 1;
  lattice.seed = 1;
  Scene scene;
  scene.camera = {{4, 3, 10}, {0, 0, 0}, {0, 1, 0}, 13};
  scene.film = {side, side};
  scene.materials = {{}};
  scene.materials[0].id = "ball";
  scene.materials[0].highlight.exponent = 1;
  scene.materials[0].diffuse_reflectance = {0.6, 0.6, 0.6};
  scene.lights = {DirectionalLight{normalize({-0.3, -0.8, -0.6}), {3, 3, 3}}};
  lattice.append_to(scene.spheres);
  return scene;
}

std::string grid_of_models(int exponents, std::string_view more_axes) {
  std::string text = fmt::format(
      "<grid version=\"1\"><scene file=\"{}\"/><axis name=\"model\" values=\"phong_rdf, modified_phong, "
      "blinn_phong_rdf, blinn_phong_ndf, modified_blinn_phong\"/><axis name=\"lobe\" values=\"cosine, "
      "cs16\"/><axis name=\"exponent\" values=\"",
      scene_file("oblique_45"));
  for (int i = 1; i <= exponents; ++i) text += fmt::format("{} ", i * 1.25);
  return fmt::format("{}\"/>{}<engine name=\"analytic\"/></grid>", text, more_axes);
}

ProcessResult run(const std::vector<std::string>& command) {
  ProcessResult result = run_process(command, {});
  if (result.exit_code == 0) return result;
  throw std::runtime_error(fmt::format("{} failed: {}", command[0], result.output_tail));
}

std::vector<std::string> render_command(const std::string& program, std::string_view scene,
                                        int width, int height, const std::filesystem::path& to) {
  return {program,
          "render",
          scene_file(scene),
          "--width",
          std::to_string(width),
          "--height",
          std::to_string(height),
          "-q",
          "-o",
          to};
}

ProcessResult render_file(const std::string& program, std::string_view scene, int width, int height,
                          const std::filesystem::path& to) {
  return run(render_command(program, scene, width, height, to));
}

void render_both_files(const std::string& program, std::string_view scene, int width, int height,
                       std::filesystem::path to) {
  auto command = render_command(program, scene, width, height, to.replace_extension("exr"));
  command.insert(command.end(), {"--png", to.replace_extension("png")});
  run(command);
}

std::vector<std::string> comparison(const std::string& program, const std::filesystem::path& a,
                                    const std::filesystem::path& b,
                                    const std::vector<std::string>& more) {
  std::vector<std::string> command{program,  "compare",     a, b, "--no-default-limits",
                                   "--fail", "max_abs=1e30"};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

ProcessResult compare(const std::string& program, const std::filesystem::path& a,
                      const std::filesystem::path& b, const std::vector<std::string>& more) {
  return run(comparison(program, a, b, more));
}

}  // namespace lobelia::bench
