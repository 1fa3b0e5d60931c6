// The frame of a program that renders by an engine's library: it takes scene after scene (persistent_session.hpp) in the form
// of camera_scene.hpp. Only the standard library, so that an engine's program loads nothing that the engine does not need.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace lobelia {

using Three = std::array<double, 3>;

/// A scene in the camera's frame. See camera_scene.hpp.
struct CameraScene {
  struct Light {
    bool is_distant = false;
    Three place{}, strength{};
  };
  struct Material {
    std::string kind;
    double exponent = 0, strength = 0;
    Three diffuse{};
  };
  struct Sphere {
    Three centre{};
    double radius = 0;
    std::size_t material = 0;
  };
  struct Plane {
    Three point{}, normal{};
    std::size_t material = 0;
  };
  std::string name;
  double seconds = 0;
  int width = 0, height = 0;
  double left = 0, right = 0, bottom = 0, top = 0;
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
};

/// RGB, the lowest row first. May throw; the message becomes the scene's failure.
using RenderScene = std::function<std::vector<float>(const CameraScene&)>;

/// main(): "PROGRAM --version" prints version(), a line; "PROGRAM FILE" renders the scene in FILE, and then those that it is
/// given. Returns the exit code.
int run_scene_program(int argc, char** argv, const std::function<std::string()>& version,
                      const RenderScene& render);

}  // namespace lobelia
