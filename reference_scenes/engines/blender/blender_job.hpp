// What render_scenes.py is told, as JSON: numbers and names of ours.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "records/struct_type.hpp"

namespace lobelia {

struct BlenderCamera {
  std::array<double, 3> origin;
  std::array<double, 3> target;
  std::array<double, 3> up;
  double fov_degrees = 0;
  std::array<double, 2> offset;
  static const records::Struct& type();
};

struct BlenderLight {
  std::string kind;
  std::optional<std::array<double, 3>> position;
  std::optional<std::array<double, 3>> intensity;
  std::optional<std::array<double, 3>> normal;
  std::optional<std::array<double, 3>> direction;
  std::optional<std::array<double, 3>> irradiance;
  std::optional<std::array<double, 3>> center;
  std::optional<std::array<double, 3>> half_u;
  std::optional<std::array<double, 3>> half_v;
  std::optional<std::array<double, 3>> radiance;
  std::string file;
  std::vector<int> lies_on;
  static const records::Struct& type();
};

struct BlenderMaterial {
  std::string model;
  std::string lobe;
  std::string normalisation;
  double exponent = 0;
  std::string fresnel;
  std::array<double, 3> specular;
  std::array<double, 3> diffuse;
  std::array<double, 3> mirror;
  static const records::Struct& type();
};

struct BlenderSphere {
  std::array<double, 3> center;
  double radius = 0;
  int material = 0;
  static const records::Struct& type();
};

struct BlenderPlane {
  std::array<double, 3> point;
  std::array<double, 3> u;
  std::array<double, 3> v;
  int material = 0;
  int checker_material = 0;
  double checker_size = 0;
  static const records::Struct& type();
};

struct BlenderPass {
  std::size_t light = 0;
  int mirrors = 0;
  static const records::Struct& type();
};

struct BlenderTransport {
  int samples = 1;
  std::uint64_t seed = 0;
  int bounces = 0;
  static const records::Struct& type();
};

struct BlenderScene {
  std::string name;
  int width = 0;
  int height = 0;
  BlenderCamera camera;
  std::vector<BlenderLight> lights;
  std::vector<BlenderMaterial> materials;
  std::vector<BlenderSphere> spheres;
  std::vector<BlenderPlane> planes;
  bool native = false;
  std::vector<BlenderPass> passes;
  std::optional<BlenderTransport> transport;
  static const records::Struct& type();
};

struct BlenderJob {
  int threads = 0;
  double seconds_per_scene = 0;
  std::vector<BlenderScene> scenes;
  std::optional<bool> go_on;
  static const records::Struct& type();
};

}  // namespace lobelia
