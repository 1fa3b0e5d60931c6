// The page of what accuracy costs in time.
#pragma once

#include <filesystem>
#include <optional>

#include "gallery/views.hpp"

namespace lobelia::gallery {

/// Of RUN/cost/cost.json; empty where there is none.
std::optional<ViewPage> cost_view(const std::filesystem::path& run);

}  // namespace lobelia::gallery
