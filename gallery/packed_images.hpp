// Pictures as scripts of a page, in no more bytes than it may have.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/image.hpp"

namespace lobelia::gallery {

/// Nothing for a picture that cannot be read: its page does without. Throws Error of any other kind.
std::optional<Image> read_if_possible(const std::filesystem::path& path);

/// What is allowed of a picture of 512 x 512 pixels, for one of the size of `image`: in proportion for a larger one.
std::size_t bytes_for(const Image& image, std::size_t of_512);

/// A script of it with so many bits (half_picture.hpp). `from_ours`: it is a difference from our picture; `block`: each
/// of its pixels stands for so many of the picture's in either direction.
std::string packed_image(const Image& image, int precision, bool from_ours, int block);

}  // namespace lobelia::gallery
