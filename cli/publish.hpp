// A farm's directory as a site, with the maps that this program can make.
#pragma once

#include <filesystem>

#include "core/error.hpp"
#include "gallery/gallery.hpp"

namespace lobelia::cli {

struct Published {
  std::filesystem::path index;
  ExitCode code = ExitCode::kSuccess;  ///< kDiffers if a cell is not as the farm wrote it
};

/// write_gallery() with a map of every difference for the eye. Names on stderr the cells that are not as the farm wrote
/// them.
Published publish(const std::filesystem::path& run, gallery::GalleryOptions options);

/// The same of a farm that has ended, where somebody wants that; tells on stderr where it is. `site` empty: nobody does.
ExitCode publish_if_wanted(const std::filesystem::path& run, const std::filesystem::path& site);

}  // namespace lobelia::cli
