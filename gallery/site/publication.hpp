// A gallery for others: a folder for a static host, or one HTML file.
#pragma once

#include "gallery/site/gallery.hpp"

namespace lobelia::gallery {

/// The most that one HTML file holds: a browser reads all of it to open it.
inline constexpr std::size_t kMostCellsOfPage = 200;
inline constexpr std::uint64_t kMostBytesOfPage = 64u << 20;

/// write_gallery() of RUN to `options.site`: one HTML file if that ends in .html, otherwise a folder.
/// Nothing has the final name before it is whole, but for a folder that is there already: its files are replaced one
/// by one. The index of the result is the file, or the folder's index.html.
/// Throws as write_gallery(), Error(kUsage) for a zip, and Error(kOutput) if something is there that is no such
/// publication, if it is the run, or if it would be larger than its form allows.
PublishedGallery write_publication(const std::filesystem::path& run, const GalleryOptions& options);

}  // namespace lobelia::gallery
