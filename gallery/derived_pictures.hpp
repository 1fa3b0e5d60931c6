// Files that the gallery makes from a cell's pictures for its page. An unchanged cell keeps those of the last time.
#pragma once

#include "core/image.hpp"
#include "gallery/checked_cell.hpp"
#include "gallery/gallery.hpp"
#include "gallery/publisher.hpp"

namespace lobelia::gallery {

/// The pictures of a cell, each read once, when it is first asked for.
class CellPictures {
 public:
  explicit CellPictures(std::filesystem::path cell_directory)
      : directory_(std::move(cell_directory)) {}
  /// Pictures that are in memory already, by the names that they would have.
  explicit CellPictures(std::map<std::string, std::optional<Image>> pictures)
      : pictures_(std::move(pictures)) {}
  /// By its file's name. Empty if it cannot be read; throws Error of any kind but kInput.
  const std::optional<Image>& of(const std::string& file);

 private:
  std::filesystem::path directory_;
  std::map<std::string, std::optional<Image>> pictures_;
};

/// Writes "NAME.small.png" for every picture of the cell that is too large a file for a preview, and names it in the
/// picture's `small`. With `all`, for every picture larger than a preview; then only that is published.
void publish_small_pictures(const std::filesystem::path& run, CheckedCell& cell, bool all,
                            Publisher& publisher);
/// Writes a picture of a cell that is in memory, and its small one if it is large.
Picture publish_shown(const std::string& cell, const std::string& file, const DisplayImage& shown,
                      bool only_small, Publisher& publisher);
/// Writes "ENGINE.float.js" for each readable EXR of the size of ours, and names it in the image's `float_script`.
/// Ours is kept as it is, every other as its difference from ours, which shows the agreement to many more digits than two
/// rounded pictures could.
void publish_float_pictures(CellPictures& pictures, const GalleryOptions& options,
                            CheckedCell& cell, Publisher& publisher);
/// Writes "ENGINE.map.ID.js" for each kind of map and each comparison of two pictures of one size on a plain display,
/// and adds it to the comparison's `maps`; and "ENGINE.region.js" with the pixels of the highlight.
void publish_difference_maps(CellPictures& pictures, const GalleryOptions& options,
                             CheckedCell& cell, Publisher& publisher);

/// Scales the bytes that a picture of 512 x 512 pixels may have to the size of `image`, if that is larger.
std::size_t bytes_for(const Image& image, std::size_t of_512);
/// A script with the picture at this precision (half_picture.hpp). `from_ours`: it is a difference from our picture.
/// `block`: one of its pixels stands for block x block of the original.
std::string packed_image(const Image& image, int precision, bool from_ours, int block);

}  // namespace lobelia::gallery
