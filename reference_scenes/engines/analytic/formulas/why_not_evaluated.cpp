#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/pixel_ray.hpp"

namespace lobelia::truth {

std::string why_not_evaluated(const Scene& scene) {
  if (!std::all_of(scene.lights.begin(), scene.lights.end(), is_delta))
    return "formulas per pixel are of directional and point lights; this scene has a light with a size";
  if (scene.camera.aperture_radius > 0)
    return "formulas per pixel are of a pinhole camera; this scene's has a lens (aperture_radius)";
  if (scene.sampler.sample_count > 1)
    return fmt::format(
        "formulas per pixel are of one ray per pixel centre; this scene asks for {} samples per pixel",
        scene.sampler.sample_count);
  if (scene.depth.glossy > 0)
    return "formulas per pixel are of direct light and perfect mirrors; this scene asks for "
           "inter-reflection (glossy_depth)";
  if (scene.spheres.size() > kMaxSpheresByRay)
    return fmt::format("formulas per pixel are of up to {} spheres; this scene has {}",
                       kMaxSpheresByRay, scene.spheres.size());
  return {};
}

}  // namespace lobelia::truth
