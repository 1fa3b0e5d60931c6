// Warnings: what is allowed and yet worth a line on stderr.
#pragma once

#include <string_view>

#include "renderer/scene/scene.hpp"

namespace lobelia::cli {

/// One line on stderr.
void warn(std::string_view text);

/// One line for each distinct thing about the scene's materials.
void warn_of(const Scene& scene);
void warn_of(const Highlight& highlight);

}  // namespace lobelia::cli
