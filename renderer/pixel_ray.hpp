// One ray at a time, without the kernels: a picture is not judged by the code that made it.
#pragma once

#include <functional>

#include "renderer/scene/scene.hpp"

namespace lobelia {

struct Hit {
  int sphere;
  Vec3 point, normal;
};

/// Each ray is tested against each sphere: more spheres would take hours.
inline constexpr std::size_t kMaxSpheresByRay = 1024;

/// The parts of a scene that single rays through the pixels' centres cannot show, in words; empty if none.
std::string beyond_single_rays(const Scene& scene);
/// Throws Error(kInput) if there are such parts; `what` was asked for: "edges".
void require_single_rays(const Scene& scene, std::string_view what);

/// From the camera through a place on the film, in pixels from its upper left corner, to the film at distance 1; not
/// normalised.
Vec3 film_ray(const CameraFrame& frame, double x, double y);
/// Through the centre of pixel (x, y).
Vec3 centre_ray(const CameraFrame& frame, int x, int y);

/// The nearest sphere along a ray of unit direction.
std::optional<Hit> nearest_hit(const Scene& scene, Vec3 origin, Vec3 direction);

/// Calls visit(i, hit, to_eye) for every pixel, i in reading order, whose centre sees `sphere`.
void for_each_pixel_of(
    const Scene& scene, int sphere,
    const std::function<void(std::size_t i, const Hit& hit, Vec3 to_eye)>& visit);

/// The light from a directional or point light at a point of a sphere. Nothing if it is below the horizon or hidden
/// by another sphere. (A sphere hides a lamp that lies on it below the lamp's horizon.)
std::optional<Illumination> light_at(const Scene& scene, int light, const Hit& hit);

/// The geometry of the highlight of one light at one place of a sphere.
struct HighlightPlace {
  double angle;             ///< the lobe's angle, radians: one of the next two
  double reflection;        ///< between the light and the mirror direction
  double half_vector;       ///< between the normal and the half vector
  double n_dot_l, n_dot_v;  ///< cosines at the light's and at the eye's side
  double irradiance;        ///< `scale` without the geometry factor
  double scale;             ///< as HighlightMap has it
};
/// Nothing where the light does not reach the place, as light_at() has it.
std::optional<HighlightPlace> highlight_at(const Scene& scene, int light, const Hit& hit,
                                           Vec3 to_eye);

/// The same for every pixel, at the pixels' centres in reading order. NaN where a
/// pixel does not see the sphere, or the light does not reach it: it is below the horizon (N.L <= 0) or another
/// sphere hides it.
struct HighlightMap {
  int width = 0, height = 0;
  std::vector<double> angle;        ///< the lobe's angle, radians: one of the next two
  std::vector<double> reflection;   ///< between the light and the mirror direction
  std::vector<double> half_vector;  ///< between the normal and the half vector
  std::vector<double> n_dot_l;      ///< cosine at the light's side
  std::vector<double> n_dot_v;      ///< cosine at the eye's side
  std::vector<double> irradiance;   ///< `scale` without the geometry factor
  /// Radiance over coefficient * lobe, as the mean of R, G and B: irradiance, reflectance with its Fresnel factor,
  /// and the model's geometry factor.
  std::vector<double> scale;
  std::vector<double> solid_angle;  ///< of the pixel as seen from the camera, steradian; never NaN
};
/// Throws as require_single_rays().
HighlightMap highlight_map(const Scene& scene, int light, int sphere);

}  // namespace lobelia
