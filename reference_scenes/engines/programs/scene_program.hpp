// The frame of a program that renders by an engine's library: it takes scene after scene (persistent_session.hpp) in the
// form of native_engine.hpp. Only the standard library, so that an engine's program loads nothing that the engine does
// not need.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace lobelia {

using Three = std::array<double, 3>;

/// A scene in the camera's frame. See native_engine.hpp.
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

// Where the rays through the pixels' centres meet a sphere, for engines that shade points that they are given.

/// Calls f(pixel, point, normal) for every pixel, from the lowest row on, whose centre sees the sphere.
template <class F>
void for_each_pixel_of(const CameraScene& scene, const CameraScene::Sphere& sphere, const F& f) {
  const Three& c = sphere.centre;
  const double outside = c[0] * c[0] + c[1] * c[1] + c[2] * c[2] - sphere.radius * sphere.radius;
  for (int j = 0; j < scene.height; ++j)
    for (int i = 0; i < scene.width; ++i) {
      const double x = scene.left + (i + 0.5) * (scene.right - scene.left) / scene.width,
                   y = scene.bottom + (j + 0.5) * (scene.top - scene.bottom) / scene.height;
      // The nearer solution t of |t (x, y, 1) - c| = radius.
      const double a = x * x + y * y + 1, b = x * c[0] + y * c[1] + c[2],
                   discriminant = b * b - a * outside;
      if (discriminant <= 0 || b <= 0) continue;
      const double t = outside / (b + std::sqrt(discriminant));
      const Three point{t * x, t * y, t};
      f(std::size_t(j) * std::size_t(scene.width) + std::size_t(i), point,
        Three{(point[0] - c[0]) / sphere.radius, (point[1] - c[1]) / sphere.radius,
              (point[2] - c[2]) / sphere.radius});
    }
}

}  // namespace lobelia
