// The attributes of a rendered picture, and the record beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/records/render.hpp"
#include "renderer/render.hpp"

namespace lobelia {

/// Attributes of the EXR: program, samples, seed, and the scene, so that the picture alone is enough to render it
/// again. No times and no paths: the same render gives the same file.
ImageMetadata render_metadata(const Scene& scene);

/// `command` renders the picture again.
records::Render render_record(const Scene& scene, const RenderResult& result,
                              const std::vector<std::string>& command,
                              const std::string& image_file);

/// The effects with their reasons, and bounds of the rays.
records::Plan plan_record(const Plan& plan);
/// The same as lines for a reader.
std::string plan_text(const Plan& plan, const Scene& scene);

records::Highlight highlight_record(const Highlight& highlight);
records::Rays rays_record(const Work& work);

}  // namespace lobelia
