// A scene's highlight profile: the scene gives each pixel its angle, the formula its truth.
#pragma once

#include "compare/profile/profile.hpp"
#include "core/image.hpp"
#include "records/profile.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// The formula at the centre of every pixel that sees `sphere`, with all lights, shadows and the diffuse base; 0 elsewhere.
/// In double, apart from the renderer's kernels.
Image analytic_image(const Scene& scene, int sphere);

/// The record of the highlight of `light` on `sphere` in those pictures. First it subtracts what other lights add by the
/// formula. The formula comes first as "analytic"; differences are of the first picture from each other one, and of each
/// from the formula. Throws Error(kInput) if there is no such light or sphere, if a single ray a pixel does not tell the
/// scene, or if a picture has not the size of the film.
records::Profile profile_scene(const Scene& scene, int light, int sphere,
                               const NamedImages& images);

/// (sphere, light) for every sphere with a highlight and every light, shown or not. Throws as profile_scene().
std::vector<std::pair<int, int>> highlights_of(const Scene& scene);

}  // namespace lobelia
