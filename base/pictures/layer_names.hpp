// The names by which people call a layer, where a file spells them differently.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

/// Finds the layers that `wanted` means, most likely first, as positions in `names`: the dotted names of each layer. Nothing
/// if it means none. Capitals, blanks, "_" and "-" do not count. In this order:
///   1. the whole name, or the end of it after a dot: "combined" for "ViewLayer.Combined";
///   2. another renderer's name for it: "albedo" for "ViewLayer.Denoising Albedo", "beauty" for "rgba";
///   3. a view ("right"): its picture.
/// Each is tried with the views in the names, and then without: "combined" for "Combined.left". `views` are those of a
/// stereo file; the first is the default. More than one result means that the name fits several layers.
std::vector<std::size_t> layers_meant(std::string_view wanted,
                                      std::span<const std::vector<std::string>> names,
                                      std::span<const std::string> views);

/// Whether the last part of a dotted name, views aside, is what a renderer calls its picture: "ViewLayer.Combined",
/// "beauty".
bool is_called_picture(std::string_view name, std::span<const std::string> views);

/// The names, those first that are most like `wanted` or have it in them; at most `most`.
std::vector<std::string> nearest_first(std::string_view wanted,
                                       std::span<const std::string_view> names, std::size_t most);

}  // namespace lobelia
