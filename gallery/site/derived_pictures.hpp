// Files that the gallery makes from a cell's pictures for its page. An unchanged cell keeps those of the last time.
#pragma once

#include "base/pictures/image.hpp"
#include "gallery/cells/checked_cell.hpp"
#include "gallery/site/gallery.hpp"
#include "gallery/site/publisher.hpp"

namespace lobelia::gallery {

/// The pictures of a cell, each read once, when it is first asked for.
class CellPictures {
 public:
  explicit CellPictures(std::filesystem::path cell_directory)
      : directory_(std::move(cell_directory)) {}
  /// Pictures that are in memory already, by the names that they would have.
  explicit CellPictures(std::map<std::string, std::optional<Image>> pictures)
      : pictures_(std::move(pictures)) {}
  /// By its file's name. Empty for a pair of which only one is a picture. Throws as read_image(): a picture with a flaw
  /// is not asked for, so one that cannot be read is a fault of the system, and what is made without it would stay.
  const std::optional<Image>& of(const std::string& file);

 private:
  std::filesystem::path directory_;
  std::map<std::string, std::optional<Image>> pictures_;
};

/// Writes "NAME.small.png" for every picture of the cell that is too large a file for a preview, and names it in the
/// picture's `small`. With `all`, for every picture larger than a preview; then only that is published.
void publish_small_pictures(const std::filesystem::path& run, CheckedCell& cell, bool all,
                            Publisher& publisher);
/// A picture for a display, decoded once.
class ShownPicture {
 public:
  /// Empty where the file is no picture. Throws Error(kInput) where it could not be read this time.
  static std::optional<ShownPicture> read(const std::filesystem::path& file);
  const Image& light() const { return light_; }
  /// With a longer side of at most `side`.
  DisplayImage within(int side) const;

 private:
  ShownPicture(std::optional<DisplayImage> plain, Image light)
      : plain_(std::move(plain)), light_(std::move(light)) {}

  std::optional<DisplayImage> plain_;
  Image light_;
};

struct Thumbnail {
  DisplayImage image;
  bool knows_surface = true;  ///< false where the scene could not be read
};

/// Our picture with a longer side of at most `side`, as a grid shows it: what is black and no surface is grey, so that the
/// spheres are seen, and a small highlight is enlarged in a corner.
Thumbnail small_thumbnail(const Image& ours, const std::filesystem::path& run,
                          const SurfaceOf& surface_of, const CheckedCell& cell, int side);
/// Writes it as "thumbnail.png" and names it in the cell's `thumbnail`.
void publish_thumbnail(const std::filesystem::path& run, const SurfaceOf& surface_of,
                       CheckedCell& cell, Publisher& publisher);
/// The same for the picture in this file, which may be elsewhere; `picture.file` is its name in the site's folder.
void publish_small_picture(const std::filesystem::path& file, const std::string& folder, bool all,
                           Picture& picture, Publisher& publisher);
/// Writes a picture of a cell that is in memory, and its small one if it is large.
Picture publish_shown(const std::string& cell, const std::string& file, const DisplayImage& shown,
                      bool only_small, Publisher& publisher);
/// Writes "ENGINE.float.js" for each readable EXR of the size of ours, and names it in the image's `float_script`.
/// Ours is kept as it is, every other as its difference from ours, which shows the agreement to many more digits than two
/// rounded pictures could.
void publish_float_pictures(CellPictures& pictures, const GalleryOptions& options,
                            CheckedCell& cell, Publisher& publisher);
/// Writes the pictures of `before`, which is this cell in the run `earlier`, that are others now: "ENGINE.before.png" or its
/// small one, and "ENGINE.before.float.js" as the difference from our picture of now. Names them in `before`; the pictures
/// that it leaves out there are the same files as now, or have another size.
void publish_before_pictures(const std::filesystem::path& earlier, CellPictures& pictures,
                             const GalleryOptions& options, const CheckedCell& cell,
                             CheckedCell& before, Publisher& publisher);

/// Writes "ENGINE.map.ID.js" for each kind of map and each comparison of two pictures of one size on a plain display,
/// and adds it to the comparison's `maps`; and "ENGINE.region.js" with the pixels of the highlight.
void publish_difference_maps(CellPictures& pictures, const GalleryOptions& options,
                             CheckedCell& cell, Publisher& publisher);

struct PictureSize {
  int width, height;
};
/// The size of a picture after its longer side is reduced to `side`. A smaller picture keeps its size.
PictureSize size_within(int width, int height, int side);
/// Each pixel is the linear mean of the pixels that it covers.
Image reduced(const Image& image, int width, int height);
/// A picture for packing.
struct PackedImage {
  std::string name;
  Image image;
  bool from_ours;
};
struct Packing {
  std::size_t bytes;
  int precision;
};
/// For all float pictures of a cell of 512 x 512 pixels; a larger one has more in proportion.
inline constexpr std::size_t kFloatPictureBytes = 416 << 10;
inline constexpr char kFloatFormat[] = "float picture 2";  ///< a new number makes all scripts anew
/// Adds a script for each image by its name, all with the finest precision that fits into `max_bytes`, or with the
/// coarsest if none fits.
Packing pack_as_fine_as_fits(const std::vector<PackedImage>& images, std::size_t max_bytes,
                             std::map<std::string, std::string>& scripts);
/// Value by value.
Image difference(const Image& theirs, const Image& ours);
/// Scales the bytes that a picture of 512 x 512 pixels may have to the size of `image`, if that is larger.
std::size_t bytes_for(const Image& image, std::size_t of_512);
/// A script with the picture at this precision (half_picture.hpp). `from_ours`: it is a difference from our picture.
/// `block`: one of its pixels stands for block x block of the original.
std::string packed_image(const Image& image, int precision, bool from_ours, int block);

}  // namespace lobelia::gallery
