#include <numbers>

#include "core/error.hpp"
#include "verify/stability/float3.hpp"
#include "verify/stability/naive.hpp"

namespace lobelia::stability::naive {
namespace {

constexpr float kEpsilon = 1e-4f;

/// Where a ray meets a sphere first, or a negative number.
float meet(const Sphere& sphere, Float3 origin, Float3 direction) {
  const Float3 way = origin - Float3(sphere.center);
  const float radius = float(sphere.radius);
  const float b = dot(way, direction), c = dot(way, way) - radius * radius;
  const float discriminant = b * b - c;
  return discriminant > 0 ? -b - std::sqrt(discriminant) : -1;
}

struct Tracer {
  explicit Tracer(const Scene& s) : scene(s) {
    if (const std::string found = beyond_delta_lights(scene); !found.empty())
      throw Error(ExitCode::kInternal, "the naive renderer does not know: " + found);
    for (const Material& material : scene.materials)
      coefficients.push_back(coefficient(material.highlight));
  }

  const Scene& scene;
  std::vector<float> coefficients;  ///< by material

  Pixel pixel(Float3 origin, Float3 direction) const {
    Pixel found;
    float nearest = 0;
    for (int k = 0; k < int(scene.spheres.size()); ++k) {
      const float t = meet(scene.spheres[k], origin, direction);
      if (!(t > 0) || (found.sphere >= 0 && t >= nearest)) continue;
      found.sphere = k;
      nearest = t;
    }
    if (found.sphere < 0) return found;
    const Sphere& sphere = scene.spheres[found.sphere];
    const Float3 point = origin + nearest * direction;
    const Float3 normal = 1 / float(sphere.radius) * (point - Float3(sphere.center));
    for (const Light& light : scene.lights)
      found.radiance = found.radiance + lit(light, sphere, point, normal, -1.0f * direction);
    return found;
  }

  Rgb lit(const Light& light, const Sphere& sphere, Float3 point, Float3 normal,
          Float3 to_eye) const {
    Float3 to_light;
    float distance = 0, falloff = 1;
    const Lamp lamp = lamp_of(light);
    if (lamp.is_distant) {
      to_light = -1.0f * Float3(lamp.direction);
    } else {
      const Float3 way = Float3(lamp.position) - point;
      distance = std::sqrt(dot(way, way));
      falloff = 1 / (distance * distance);
      to_light = 1 / distance * way;
    }
    for (const Sphere& other : scene.spheres) {
      const float t = meet(other, point, to_light);
      if (t > kEpsilon && (distance == 0 || t < distance)) return {};
    }
    const Material& material = scene.materials[sphere.material];
    const float value = coefficients[sphere.material] *
                        unit_shape(material.highlight, normal, to_eye, to_light) * falloff;
    return double(value) * (lamp.strength * material.specular_reflectance);
  }
};

}  // namespace

std::vector<Pixel> picture(const Scene& scene) {
  const Camera& camera = scene.camera;
  const Float3 forward = normalize(Float3(camera.target) - Float3(camera.origin));
  const Float3 right = normalize(cross(forward, Float3(camera.up))), up = cross(right, forward);
  const float half_width = std::tan(float(camera.fov_degrees) * std::numbers::pi_v<float> / 360);
  const float half_height = half_width * float(scene.film.height) / float(scene.film.width);
  const Tracer tracer(scene);
  std::vector<Pixel> pixels;
  for (int y = 0; y < scene.film.height; ++y)
    for (int x = 0; x < scene.film.width; ++x) {
      const float u = (2 * (float(x) + 0.5f) / float(scene.film.width) - 1) * half_width;
      const float v = (1 - 2 * (float(y) + 0.5f) / float(scene.film.height)) * half_height;
      pixels.push_back(
          tracer.pixel(Float3(camera.origin), normalize(forward + u * right + v * up)));
    }
  return pixels;
}

}  // namespace lobelia::stability::naive
