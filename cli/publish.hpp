// A farm's directory as a site, with the maps that this program can make.
#pragma once

#include <filesystem>

#include "gallery/gallery.hpp"

namespace lobelia::cli {

/// write_gallery() with a map of every difference for the eye. Returns the path of the index.
std::filesystem::path publish(const std::filesystem::path& run, gallery::GalleryOptions options);

/// The same of a farm that has ended, where somebody wants that; tells on stderr where it is. `site` empty: nobody does.
void publish_if_wanted(const std::filesystem::path& run, const std::filesystem::path& site);

}  // namespace lobelia::cli
