#include "renderer/pixel_ray.hpp"

#include <fmt/format.h>

#include "base/system/error.hpp"
#include "renderer/chord.hpp"
#include "renderer/scene/contact.hpp"

namespace lobelia {

std::string beyond_single_rays(const Scene& scene) {
  std::string found = beyond_delta_lights(scene);
  if (scene.spheres.size() > kMaxSpheresByRay)
    found += fmt::format("{}over {} spheres", found.empty() ? "" : ", ", kMaxSpheresByRay);
  return found;
}

void require_single_rays(const Scene& scene, std::string_view what) {
  if (const std::string found = beyond_single_rays(scene); !found.empty())
    throw Error(ExitCode::kInput,
                "{} can be told of a scene of up to {} spheres under directional and "
                "point lights; this one has more: {}",
                what, kMaxSpheresByRay, found);
}

Vec3 film_ray(const CameraFrame& frame, double x, double y) {
  return frame.forward + frame.film_u(x) * frame.right + frame.film_v(y) * frame.up;
}

Vec3 centre_ray(const CameraFrame& frame, int x, int y) {
  return film_ray(frame, x + 0.5, y + 0.5);
}

std::optional<Hit> nearest_hit(const Scene& scene, Vec3 origin, Vec3 direction) {
  std::optional<Hit> nearest;
  double nearest_t = kInfinity;
  for (int k = 0; k < int(scene.spheres.size()); ++k) {
    const Sphere& sphere = scene.spheres[k];
    const Chord chord = chord_of(sphere, origin, direction);
    if (!(chord.half_squared > 0)) continue;
    const double t = chord.entry();
    if (!(t > 0 && t < nearest_t) || !is_outside(sphere, origin)) continue;
    nearest_t = t;
    const Vec3 normal = normalize(-(chord.off_axis + chord.half() * direction));
    nearest = Hit{k, sphere.center + sphere.radius * normal, normal};
  }
  return nearest;
}

void for_each_pixel_of(const Scene& scene, int sphere,
                       const std::function<void(std::size_t, const Hit&, Vec3)>& visit) {
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const Sphere& wanted = scene.spheres.at(std::size_t(sphere));
  for (int y = 0; y < scene.film.height; ++y)
    for (int x = 0; x < scene.film.width; ++x) {
      const Vec3 direction = normalize(centre_ray(frame, x, y));
      // Most pixels miss this sphere and need no test of the others.
      if (!(chord_of(wanted, frame.origin, direction).half_squared > 0)) continue;
      const auto hit = nearest_hit(scene, frame.origin, direction);
      if (hit && hit->sphere == sphere)
        visit(std::size_t(y) * scene.film.width + x, *hit, -direction);
    }
}

std::optional<Illumination> light_at(const Scene& scene, int light, const Hit& hit) {
  const Light& lamp = scene.lights.at(std::size_t(light));
  const Illumination here = illuminate(lamp, hit.point);
  if (!(dot(hit.normal, here.to_light) > 0)) return std::nullopt;
  for (int k = 0; k < int(scene.spheres.size()); ++k)
    if (k != hit.sphere && is_inside(scene.spheres[std::size_t(k)], hit.point)) return std::nullopt;
  // Above the horizon the ray never meets the sphere itself.
  const auto before = nearest_hit(scene, hit.point, here.to_light);
  if (!before || !(length(before->point - hit.point) < here.distance)) return here;
  const Sphere& sphere = scene.spheres[std::size_t(before->sphere)];
  if (!lies_on(lamp, sphere, closeness(scene)) || horizon_of(lamp, sphere)->is_below(hit.point))
    return std::nullopt;
  return here;
}

std::optional<HighlightPlace> highlight_at(const Scene& scene, int light, const Hit& hit,
                                           Vec3 to_eye) {
  const auto here = light_at(scene, light, hit);
  if (!here) return std::nullopt;
  const Material& material =
      scene.materials.at(std::size_t(scene.spheres.at(std::size_t(hit.sphere)).material));
  const Highlight& highlight = material.highlight;
  const Vec3 to_light = here->to_light;
  HighlightPlace place{};
  place.n_dot_l = dot(hit.normal, to_light);
  place.n_dot_v = dot(hit.normal, to_eye);
  const Rgb reflected =
      here->irradiance *
      fresnel_factor(material.fresnel, material.specular_reflectance, to_eye, to_light);
  place.irradiance = (reflected.r + reflected.g + reflected.b) / 3;
  place.scale = geometry_factor(highlight.model, highlight.exponent, place.n_dot_l, place.n_dot_v) *
                place.irradiance;
  place.reflection = angle_between(2 * place.n_dot_v * hit.normal - to_eye, to_light);
  place.half_vector = angle_between(hit.normal, normalize(to_light + to_eye));
  place.angle =
      info(highlight.model).angle == LobeAngle::kReflection ? place.reflection : place.half_vector;
  return place;
}

HighlightMap highlight_map(const Scene& scene, int light, int sphere) {
  require_single_rays(scene, "the angles of a highlight");
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const int width = scene.film.width, height = scene.film.height;
  const std::size_t pixels = std::size_t(width) * height;
  const std::vector nowhere(pixels, kNaN);
  HighlightMap map{width,   height,  nowhere, nowhere, nowhere,
                   nowhere, nowhere, nowhere, nowhere, std::vector(pixels, 0.0)};
  const double pixel_area = 4 * frame.half_width * frame.half_height / double(pixels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double distance = length(centre_ray(frame, x, y));
      map.solid_angle[std::size_t(y) * width + x] = pixel_area / (distance * distance * distance);
    }

  for_each_pixel_of(scene, sphere, [&](std::size_t i, const Hit& hit, Vec3 to_eye) {
    const auto place = highlight_at(scene, light, hit, to_eye);
    if (!place) return;
    map.angle[i] = place->angle;
    map.reflection[i] = place->reflection;
    map.half_vector[i] = place->half_vector;
    map.n_dot_l[i] = place->n_dot_l;
    map.n_dot_v[i] = place->n_dot_v;
    map.irradiance[i] = place->irradiance;
    map.scale[i] = place->scale;
  });
  return map;
}

}  // namespace lobelia
