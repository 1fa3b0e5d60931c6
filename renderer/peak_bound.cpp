#include "renderer/peak_bound.hpp"

#include "renderer/scene/contact.hpp"

namespace lobelia {

double nearest_surface(const Lamp& lamp, const Scene& scene, double closeness) {
  const Light light = light_of(lamp);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Sphere& sphere : scene.spheres) {
    const double distance = length(lamp.position - sphere.center) - sphere.radius;
    if (distance > 0 && !lies_on(light, sphere, closeness)) nearest = std::min(nearest, distance);
  }
  for (const Plane& plane : scene.planes) {
    const double distance = std::abs(dot(lamp.position - plane.point, plane.normal));
    if (distance > 0 && !lies_on(light, plane, closeness)) nearest = std::min(nearest, distance);
  }
  return std::isfinite(nearest) ? nearest : 1.0;
}

double peak_bound(const Scene& scene, const std::vector<Light>& lights,
                  std::optional<double> shadowing) {
  double reflected = 0, mirrored = 0;  // at most, of unit irradiance and of unit radiance
  const auto add = [&](int index) {
    const Material& m = scene.materials.at(std::size_t(index));
    const bool schlick = m.fresnel != Fresnel::kNone;
    const double specular = schlick ? 1 : max_component(m.specular_reflectance);
    const Highlight& h = m.highlight;
    const double largest = largest_shadowing(h.model, h.exponent);
    const double highlight =
        radiance_coefficient(h) *
        (info(h.model).has_shadowing ? std::min(largest, shadowing.value_or(largest)) : 1);
    reflected = std::max(
        reflected, highlight * specular + max_component(m.diffuse_reflectance) / std::numbers::pi);
    mirrored = std::max(mirrored, schlick ? mirror_at_grazing(m.mirror_reflectance)
                                          : max_component(m.mirror_reflectance));
  };
  for (const Sphere& sphere : scene.spheres) add(sphere.material);
  for (const Plane& plane : scene.planes) {
    add(plane.material);
    add(plane.checker_material);
  }
  double irradiance = 0;
  const double close = closeness(scene);
  for (const Light& light : lights) {
    if (const auto lamp = find_near_lamp(light)) {
      const double distance = nearest_surface(*lamp, scene, close);
      irradiance += max_component(lamp->strength) / (distance * distance);
    } else {
      irradiance += max_component(strength(light));
    }
  }
  double sum = 1, power = 1;  // over mirrors that show each other
  for (int i = 0; i < scene.depth.mirror; ++i) sum += power *= mirrored;
  return reflected * irradiance * sum;
}

}  // namespace lobelia
