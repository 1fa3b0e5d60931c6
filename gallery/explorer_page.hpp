// The page on which a highlight can be chosen and looked at.
#pragma once

#include <filesystem>
#include <optional>

#include "gallery/views.hpp"

namespace lobelia::gallery {

/// Of RUN/explorer/tables.json; empty where there is none.
std::optional<ViewPage> explorer_view(const std::filesystem::path& run);

}  // namespace lobelia::gallery
