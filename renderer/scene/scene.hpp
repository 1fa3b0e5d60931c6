// A scene as plain data, already checked: every Scene keeps to the ranges given here.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/words/vec.hpp"
#include "renderer/filter.hpp"
#include "renderer/fresnel.hpp"
#include "renderer/highlight.hpp"
#include "renderer/scene/lights/lights.hpp"

namespace lobelia {

/// A perspective camera. `origin`, `target` differ and `up` is not along the view.
struct Camera {
  Vec3 origin, target, up;
  double fov_degrees = 28;     ///< full horizontal angle of view, (0, 180)
  double aperture_radius = 0;  ///< of a thin lens, >= 0; 0 is a pinhole
  double focus_distance = 1;   ///< > 0; along the view, of the plane that is sharp
  /// The point where the view from origin to target meets the film, relative to its centre: to the right, in
  /// widths, and upwards, in heights; -10..10 each.
  double principal_point_offset_x = 0, principal_point_offset_y = 0;
};

struct Film {
  int width = 256, height = 256;  ///< 1..kMaxImageSide each, at most kMaxFilmPixels together
  Filter filter = {};             ///< used only where sample_count > 1
};

struct Sampler {
  int sample_count = 1;    ///< rays per pixel, 1..65536; 1 means the pixel's centre
  std::uint64_t seed = 0;  ///< used only where sample_count > 1
  /// Whether the pixels around a highlight smaller than a pixel are averaged, where one ray a pixel was asked for. Engines
  /// take the centre's ray alone, and so do comparisons with them.
  bool averages_small_highlights = false;
};

struct Material {
  std::string id;            ///< from the file: untrusted text, for people only
  Highlight highlight;       ///< model, lobe, normalisation, exponent
  Rgb specular_reflectance;  ///< scales the highlight, each 0..1; F0 of Schlick's Fresnel factor
  Rgb diffuse_reflectance;   ///< Lambertian albedo beneath it, each 0..1
  Fresnel fresnel = Fresnel::kNone;
  Rgb mirror_reflectance = {};  ///< of a perfect mirror on top, each 0..1; F0 of its Fresnel factor
};

inline bool is_mirror(const Material& material) { return !is_black(material.mirror_reflectance); }
/// Schlick's factor makes a highlight even of a black reflectance.
inline bool has_highlight(const Material& material) {
  return !is_black(material.specular_reflectance) || material.fresnel != Fresnel::kNone;
}

struct Sphere {
  Vec3 center;
  double radius = 1;  ///< > 0
  int material = 0;   ///< index into Scene::materials
};

/// A point below the inner radius is inside the sphere, one beyond the outer radius is outside. Between the two it
/// lies on the sphere, by the rounding of its coordinates.
double inner_radius(const Sphere& sphere);
double outer_radius(const Sphere& sphere);

/// An infinite plane, seen and lit from both sides.
struct Plane {
  Vec3 point, normal;  ///< normal of unit length
  int material = 0;    ///< index into Scene::materials
  /// The material of every other square; the same as `material` without a checker.
  int checker_material = 0;
  double checker_size =
      1;  ///< side of a square, > 0; squares are along tangents(normal) from `point`
};

/// The most times that light goes on from surface to surface before it reaches the camera.
struct Depth {
  int mirror = 0;  ///< by mirrors, 0..64
  int glossy = 0;  ///< by highlights and diffuse bases, 0..64
};

struct Scene {
  Camera camera;
  Film film;
  Sampler sampler;
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  Depth depth;
};

/// Right-handed orthonormal frame of the camera and the half-sizes of the picture at distance 1.
/// The ray through (x, y) of the film, in pixels from its upper left corner, starts at origin and runs along
/// forward + film_u(x) right + film_v(y) up.
struct CameraFrame {
  Vec3 origin, right, up, forward;
  double half_width = 0, half_height = 0;
  double shift_u = 0, shift_v = 0;  ///< of the film's centre
  int width = 1, height = 1;        ///< of the film, pixels

  double film_u(double x) const { return (2 * x / width - 1) * half_width + shift_u; }
  double film_v(double y) const { return (1 - 2 * y / height) * half_height + shift_v; }
};
CameraFrame camera_frame(const Camera& camera, const Film& film);

/// The parts of a scene beyond direct light from delta lights on spheres, in words: "an area light, a ground plane".
/// Every engine and every analysis can take a scene without such parts.
std::string beyond_delta_lights(const Scene& scene);

/// Warnings about a scene that can be rendered but is probably not meant that way, with the effect on the picture: no
/// light, a camera inside a sphere or turned away from everything, a light inside a sphere. At most a few lines, with
/// any number of spheres.
std::vector<std::string> remarks(const Scene& scene);

}  // namespace lobelia
