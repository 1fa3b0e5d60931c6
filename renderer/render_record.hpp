// The attributes in a rendered picture, and the record beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "records/render.hpp"
#include "renderer/render.hpp"

namespace lobelia {

/// Attributes of the EXR: what made it, samples, seed, and the scene itself, so that a picture can be
/// rendered again from nothing else. No times and no paths: the same render is the same file.
ImageMetadata render_metadata(const Scene& scene);

/// `command` is what to type to make it again.
records::Render render_record(const Scene& scene, const RenderResult& result,
                              const std::vector<std::string>& command,
                              const std::string& image_file);

/// The effects with their reasons, and the rays expected.
records::Plan plan_record(const Plan& plan);

records::Highlight highlight_record(const Highlight& highlight);
records::Rays rays_record(const Work& work);

}  // namespace lobelia
