// A farm's directory as a site, with the maps that this program can make.
#pragma once

#include "base/system/error.hpp"
#include "gallery/site/gallery.hpp"

namespace lobelia::cli {

/// The maps, regions and metrics that pages can show.
gallery::GalleryOptions gallery_options();

/// Draws a run as a site: write_gallery() or write_publication().
using WriteSite = gallery::PublishedGallery(const std::filesystem::path&,
                                            const gallery::GalleryOptions&);

/// `write` with a map of every visible difference. Lists on stderr the cells that are not as the farm wrote them.
gallery::PublishedGallery publish(const std::filesystem::path& run, gallery::GalleryOptions options,
                                  WriteSite& write = gallery::write_gallery);

/// publish() of a finished farm into `site`, and its path on stderr. Does nothing if `site` is empty. kDiffers if a
/// cell is not as the farm wrote it.
ExitCode publish_if_wanted(const std::filesystem::path& run, const std::filesystem::path& site);

}  // namespace lobelia::cli
