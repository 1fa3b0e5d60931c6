// The metadata of a reference picture.
#pragma once

#include "core/image.hpp"
#include "records/render.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Attributes of the EXR: which engine made it and how, and the scene. No times and no paths: the same reference is
/// the same file.
ImageMetadata reference_metadata(const Scene& scene, const records::Reference& record);

}  // namespace lobelia
