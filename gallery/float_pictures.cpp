#include "gallery/float_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "core/image_values.hpp"
#include "gallery/half_picture.hpp"
#include "gallery/packed_images.hpp"

namespace lobelia::gallery {
namespace {

constexpr char kFormat[] = "float picture 2";  // of the scripts; another number makes them anew

Image difference(const Image& theirs, const Image& ours) {
  Image result = theirs;
  for (std::size_t i = 0; i < result.values().size(); ++i) result.values()[i] -= ours.values()[i];
  return result;
}

struct PackedImage {
  std::string name;
  Image image;
  bool from_ours;
};

struct Packing {
  std::size_t bytes;
  int precision;
};

/// Adds a script of each by its name, all with the finest precision with which they fit into `most` bytes; with the
/// coarsest if not even those do.
Packing pack_as_fine_as_fits(const std::vector<PackedImage>& images, std::size_t most,
                             std::map<std::string, std::string>& scripts) {
  if (images.empty()) return {0, kFinest};
  int fits = kCoarsest, too_fine = kFinest + 1;  // by bisection
  std::size_t used = 0;
  for (int precision = kFinest; used == 0 || too_fine - fits > 1;) {
    std::map<std::string, std::string> made;
    std::size_t size = 0;
    for (const PackedImage& one : images)
      size += (made[one.name] = packed_image(one.image, precision, one.from_ours, 1)).size();
    if (size > most && precision > kCoarsest) {
      too_fine = precision;
    } else {
      fits = precision;
      used = size;
      for (auto& [name, script] : made) scripts[name] = std::move(script);
    }
    precision = used == 0 && too_fine - fits <= 1 ? kCoarsest : (fits + too_fine) / 2;
  }
  return {used, fits};
}

/// All scripts of a cell, made together when the first is asked for: a second publication reads no picture.
class CellScripts {
 public:
  CellScripts(CellPictures& pictures, const CheckedCell& cell) : pictures_(pictures), cell_(cell) {}

  std::string of(const std::string& engine) {
    if (!made_) make();
    made_ = true;
    return scripts_[engine];
  }

 private:
  void make() {
    const EnginePicture* our_image = cell_.find_image(kOurEngine);
    const std::optional<Image>& ours = pictures_.of(our_image->exr);
    if (!ours) return;
    std::vector<PackedImage> others;
    // What is not finite in ours would hide theirs in a difference.
    const bool from_ours = is_finite(*ours);
    for (const EnginePicture& image : cell_.images) {
      if (&image == our_image || image.exr.empty()) continue;
      const std::optional<Image>& theirs = pictures_.of(image.exr);
      if (!theirs || theirs->width() != ours->width() || theirs->height() != ours->height())
        continue;
      others.push_back({image.engine, from_ours ? difference(*theirs, *ours) : *theirs, from_ours});
    }
    const std::size_t most = bytes_for(*ours, kFloatPictureBytes);
    std::vector<PackedImage> first;
    first.push_back({kOurEngine, *ours, false});
    // Noise takes all that it gets: half is for the others, and what they leave for ours again.
    const Packing half = pack_as_fine_as_fits(first, most / 2, scripts_);
    const std::size_t rest = most - std::min(most, half.bytes);
    const Packing theirs = pack_as_fine_as_fits(others, rest, scripts_);
    if (half.precision < kFinest && theirs.bytes < rest)
      pack_as_fine_as_fits(first, most - theirs.bytes, scripts_);
  }

  CellPictures& pictures_;
  const CheckedCell& cell_;
  bool made_ = false;
  std::map<std::string, std::string> scripts_;
};

}  // namespace

void publish_float_pictures(CellPictures& pictures, CheckedCell& cell, Publisher& publisher) {
  const EnginePicture* our_image = cell.find_image(kOurEngine);
  if (!our_image || our_image->exr.empty()) return;
  // Each script depends on all pictures of the cell, by the bytes that are left for it.
  std::string all_hashes;
  for (const EnginePicture& image : cell.images)
    all_hashes += (all_hashes.empty() ? "" : " ") + image.exr_sha256;
  CellScripts scripts(pictures, cell);
  for (EnginePicture& image : cell.images) {
    if (image.exr.empty()) continue;
    const std::string file = image.engine + ".float.js";
    const bool made =
        publisher.derive("cells/" + cell.id + "/" + file,
                         fmt::format("{} of {}, {}", kFormat, kFloatPictureBytes, all_hashes),
                         [&] { return scripts.of(image.engine); });
    if (made) image.float_script = file;
  }
}

}  // namespace lobelia::gallery
