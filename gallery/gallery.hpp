// From a farm's records to a static site that opens from a double-click, without a network.
//
// The room has a namespace of its own, because it has its own idea of an axis, a limit and a cell:
// what records say of them, as against what they are to those that wrote the records.
#pragma once

#include <filesystem>

namespace lobelia::gallery {

/// Reads DIR/farm.json and the records it names; writes DIR/index.html, DIR/style.css,
/// DIR/gallery.js and DIR/cells/ID/index.html. Draws what the records say and computes nothing
/// but the subtraction of two curves for a chart. A record of one cell that cannot be read is said
/// on that cell's page; Error(kInput) only if farm.json itself cannot be read. Returns the path of
/// the index.
std::filesystem::path write_gallery(const std::filesystem::path& directory);

}  // namespace lobelia::gallery
