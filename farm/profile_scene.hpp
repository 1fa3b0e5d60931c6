// The profile of a scene's highlight, in pictures and by the formula.
#pragma once

#include "base/pictures/image.hpp"
#include "base/records/profile.hpp"
#include "profile/profile.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// The formula at the centre of every pixel that sees `sphere`, with all lights, shadows and the diffuse base; 0 elsewhere.
/// In double, apart from the renderer's kernels.
Image analytic_image(const Scene& scene, int sphere);

/// The record of the highlight of `light` on `sphere` in these pictures, after subtracting the formula's value for the
/// other lights. The formula comes first, as "analytic"; differences are those of the first picture from each other one,
/// and of each from the formula. Throws Error(kInput) if there is no such light or sphere, if the scene needs more than a
/// single ray a pixel, or if a picture's size is not the film's.
///
/// If `thorough`, figures have standard errors, and every family of lobes is fitted. `noise` is that of each picture;
/// null or missing if unknown.
///
/// `shown` says what the pixels of the pictures show. By default means with the film's filter if the scene has several
/// samples per pixel. With one sample it is unknown, since the pictures may be from other settings: a thorough profile
/// finds out, and another one takes them for centres. For means, the formula is a mean too.
records::Profile profile_scene(const Scene& scene, int light, int sphere, const NamedImages& images,
                               bool thorough = false,
                               const std::vector<const PictureNoise*>& noise = {},
                               std::optional<PixelsShow> shown = {});

/// (sphere, light) for every sphere with a highlight and every light, visible or not. Throws as profile_scene().
std::vector<std::pair<int, int>> highlights_of(const Scene& scene);

}  // namespace lobelia
