// A scene as plain data, already checked: whatever holds a Scene may rely on the ranges given here.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/vec.hpp"
#include "renderer/fresnel.hpp"
#include "renderer/highlight.hpp"

namespace lobelia {

/// A perspective camera. `origin`, `target` differ and `up` is not along the view.
struct Camera {
  Vec3 origin, target, up;
  double fov_degrees = 28;  ///< full horizontal angle of view, (0, 180)
};

struct Film {
  int width = 256, height = 256;  ///< 1..kMaxImageSide each, at most kMaxImagePixels together
};

struct Sampler {
  int sample_count = 1;    ///< rays per pixel, 1..65536; 1 means the pixel's centre
  std::uint64_t seed = 0;  ///< used only where sample_count > 1
};

/// Parallel light. `direction` is where the light travels (as in Mitsuba), unit length.
struct DirectionalLight {
  Vec3 direction;
  Rgb irradiance;  ///< on a plane normal to the beam, W/m^2, >= 0
};

struct PointLight {
  Vec3 position;
  Rgb intensity;  ///< W/sr, >= 0; irradiance falls with the square of the distance
};

using Light = std::variant<DirectionalLight, PointLight>;

/// What the light is as bright as: a directional light's irradiance, a point light's intensity.
inline Rgb strength(const Light& light) {
  const auto* directional = std::get_if<DirectionalLight>(&light);
  return directional ? directional->irradiance : std::get<PointLight>(light).intensity;
}

struct Material {
  std::string id;            ///< from the file: untrusted text, for people only
  Highlight highlight;       ///< model, lobe, normalisation, exponent
  Rgb specular_reflectance;  ///< scales the highlight, each 0..1; F0 of Schlick's Fresnel factor
  Rgb diffuse_reflectance;   ///< Lambertian albedo beneath it, each 0..1
  Fresnel fresnel = Fresnel::kNone;
};

struct Sphere {
  Vec3 center;
  double radius = 1;  ///< > 0
  int material = 0;   ///< index into Scene::materials
};

/// What is nearer to the sphere's centre than this is inside; what is not may lie on the sphere, by the
/// rounding of its place.
double inner_radius(const Sphere& sphere);

struct Scene {
  Camera camera;
  Film film;
  Sampler sampler;
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Sphere> spheres;
};

/// Right-handed orthonormal frame of the camera and the half-sizes of the picture at distance 1.
/// The ray of pixel (i, j), j down, at offset (u, v) in the pixel, starts at origin and runs along
///   forward + (2 (i + u) / width - 1) half_width right + (1 - 2 (j + v) / height) half_height up.
struct CameraFrame {
  Vec3 origin, right, up, forward;
  double half_width = 0, half_height = 0;
};
CameraFrame camera_frame(const Camera& camera, const Film& film);

/// Unit vector from `point` to the light, the irradiance it brings on a plane normal to that
/// vector, and the distance to it (infinite for a directional light).
struct Illumination {
  Vec3 to_light;
  Rgb irradiance;
  double distance = 0;
};
Illumination illuminate(const Light& light, Vec3 point);

}  // namespace lobelia
