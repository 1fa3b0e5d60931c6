#include "renderer/peak_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lobelia {

double nearest_surface(const PointLight& light, const std::vector<Sphere>& spheres) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Sphere& sphere : spheres) {
    const double distance = length(light.position - sphere.center) - sphere.radius;
    if (distance > 0) nearest = std::min(nearest, distance);
  }
  return std::isfinite(nearest) ? nearest : 1.0;
}

double peak_bound(const Scene& scene, const std::vector<Light>& lights) {
  double reflected = 0;  // of unit irradiance, over all spheres
  for (const Sphere& sphere : scene.spheres) {
    const Material& material = scene.materials.at(std::size_t(sphere.material));
    const double specular =
        material.fresnel == Fresnel::kNone ? max_component(material.specular_reflectance) : 1;
    reflected =
        std::max(reflected, radiance_coefficient(material.highlight) * specular +
                                max_component(material.diffuse_reflectance) / std::numbers::pi);
  }
  double irradiance = 0;
  for (const Light& light : lights) {
    if (const auto* point = std::get_if<PointLight>(&light)) {
      const double distance = nearest_surface(*point, scene.spheres);
      irradiance += max_component(point->intensity) / (distance * distance);
    } else {
      irradiance += max_component(strength(light));
    }
  }
  return reflected * irradiance;
}

}  // namespace lobelia
