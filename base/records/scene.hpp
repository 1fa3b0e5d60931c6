// A scene with everything resolved to numbers, for other programs.
#pragma once

#include <array>

#include "base/records/struct_type.hpp"

namespace lobelia::records {

/// x, y, z or red, green, blue.
using Triple = std::array<double, 3>;

struct SceneCamera {
  Triple origin{}, right{}, up{}, forward{};
  double half_width = 0, half_height = 0, shift_u = 0, shift_v = 0;
  double aperture_radius = 0, focus_distance = 0;
};

struct SceneFilm {
  int width = 0, height = 0, samples = 0;
  std::uint64_t seed = 0;
  std::string filter;
  double filter_radius = 0;
};

struct SceneLight {
  std::string type, kind;
  std::optional<Triple> position, direction, normal, center, half_u, half_v;
  std::optional<double> radius, cutoff_degrees, beam_degrees;
  std::string filename;
  Triple strength{};
  std::string unit;
};

struct SceneMaterial {
  std::string id, model, lobe, normalisation, lobe_formula, angle;
  bool applies_cosine = false, has_shadowing = false;
  double exponent = 0, coefficient = 0;
  Triple specular{}, diffuse{}, mirror{};
  std::string fresnel;
  double mirror_at_grazing = 0;
};

struct SceneSphere {
  Triple center{};
  double radius = 0;
  int material = 0;
};

struct ScenePlane {
  Triple point{}, normal{};
  int material = 0;
  std::optional<int> checker_material;
  std::optional<double> checker_size;
};

struct SceneDepth {
  int mirror = 0, glossy = 0;
};

struct Scene {
  SceneCamera camera;
  SceneFilm film;
  SceneDepth depth;
  std::vector<SceneLight> lights;
  std::vector<SceneMaterial> materials;
  std::vector<SceneSphere> spheres;
  std::vector<ScenePlane> planes;
};

void define_scene_tables(Tables& tables);

}  // namespace lobelia::records
