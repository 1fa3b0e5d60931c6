// The page of the paper's claims, measured.
#pragma once

#include <filesystem>
#include <optional>

#include "gallery/views.hpp"

namespace lobelia::gallery {

/// Of RUN/paper/paper.json; empty where there is none.
std::optional<ViewPage> paper_view(const std::filesystem::path& run);

}  // namespace lobelia::gallery
