// The page of the hard cases: the textbook's float32 beside ours.
#pragma once

#include <filesystem>
#include <optional>

#include "gallery/views.hpp"

namespace lobelia::gallery {

/// Of RUN/stability/stability.json; empty where there is none.
std::optional<ViewPage> stability_view(const std::filesystem::path& run);

}  // namespace lobelia::gallery
