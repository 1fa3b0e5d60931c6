// A scene's highlight profile: the scene gives each pixel its angle, the formula its truth.
#pragma once

#include "compare/profile/profile.hpp"
#include "core/image.hpp"
#include "records/profile.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// The formula at the centre of every pixel that sees `sphere`: all lights with their shadows, diffuse base
/// included; 0 elsewhere. Evaluated in double, apart from the renderer's kernels.
Image analytic_image(const Scene& scene, int sphere);

/// The record of the highlight of `light` on `sphere` in those pictures, which come in the order of the report.
/// What other lights add by the formula is subtracted first, and left as it is where a picture has it otherwise.
/// The formula is added in front as "analytic"; differences are of the first picture from each other one, and of
/// each from the formula. Throws Error(kInput) if there is no such light or sphere, if the scene has what a
/// single ray a pixel does not tell, or if a picture has not the size of the scene's film.
records::Profile profile_scene(const Scene& scene, int light, int sphere,
                               const NamedImages& images);

/// Every sphere whose material has a highlight, with every light, as (sphere, light). Whether the picture
/// shows it is for its record to say. Throws as profile_scene() does.
std::vector<std::pair<int, int>> highlights_of(const Scene& scene);

}  // namespace lobelia
