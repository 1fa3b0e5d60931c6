// Compares two scenes except for the names of their materials. Comparing their written text would not find what the writer
// leaves out.
#pragma once

#include <algorithm>
#include <tuple>

#include "renderer/scene/scene.hpp"

namespace lobelia::fuzz {

// Structured bindings name every field, so that a struct with a new one does not compile until it is added here.

inline auto fields(const Camera& c) {
  const auto& [origin, target, up, fov, aperture, focus, offset_x, offset_y] = c;
  return std::tie(origin, target, up, fov, aperture, focus, offset_x, offset_y);
}
inline auto fields(const Film& f) {
  const auto& [width, height, filter] = f;
  return std::tie(width, height, filter);
}
inline auto fields(const Sampler& s) {
  const auto& [samples, seed, averages] = s;
  return std::tie(samples, seed, averages);
}
inline auto fields(const Highlight& h) {
  const auto& [model, lobe, normalisation, exponent] = h;
  return std::tie(model, lobe, normalisation, exponent);
}
inline auto fields(const Material& m) {
  const auto& [id, highlight, specular, diffuse, fresnel, mirror] = m;
  return std::tuple_cat(fields(highlight), std::tie(specular, diffuse, fresnel, mirror));
}
inline auto fields(const Sphere& s) {
  const auto& [center, radius, material] = s;
  return std::tie(center, radius, material);
}
inline auto fields(const Plane& p) {
  const auto& [point, normal, material, checker_material, checker_size] = p;
  return std::tie(point, normal, material, checker_material, checker_size);
}
inline auto fields(const Depth& d) {
  const auto& [mirror, glossy] = d;
  return std::tie(mirror, glossy);
}

inline bool same_scene(const Scene& a, const Scene& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const auto& p, const auto& q) { return fields(p) == fields(q); });
  };
  const auto& [camera, film, sampler, lights, materials, spheres, planes, depth] = a;
  return fields(camera) == fields(b.camera) && fields(film) == fields(b.film) &&
         fields(sampler) == fields(b.sampler) && fields(depth) == fields(b.depth) &&
         equal(materials, b.materials) && equal(spheres, b.spheres) && equal(planes, b.planes) &&
         lights == b.lights;
}

}  // namespace lobelia::fuzz
