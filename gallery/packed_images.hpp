// Pictures as scripts of a page, in no more bytes than it may have.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/image.hpp"

namespace lobelia::gallery {

/// The pictures of a cell, each read when it is first asked for: a second publication reads none, and the first each
/// once.
class CellPictures {
 public:
  explicit CellPictures(std::filesystem::path cell_directory)
      : directory_(std::move(cell_directory)) {}
  /// By its file's name. Nothing for one that cannot be read: its page does without. Throws Error of any other kind.
  const std::optional<Image>& of(const std::string& file);

 private:
  std::filesystem::path directory_;
  std::map<std::string, std::optional<Image>> pictures_;
};

/// What is allowed of a picture of 512 x 512 pixels, for one of the size of `image`: in proportion for a larger one.
std::size_t bytes_for(const Image& image, std::size_t of_512);

/// A script of it with so many bits (half_picture.hpp). `from_ours`: it is a difference from our picture; `block`: each
/// of its pixels stands for so many of the picture's in either direction.
std::string packed_image(const Image& image, int precision, bool from_ours, int block);

}  // namespace lobelia::gallery
