#include <fmt/format.h>

#include "base/pictures/image_values.hpp"
#include "gallery/packed/half_picture.hpp"
#include "gallery/site/derived_pictures.hpp"

namespace lobelia::gallery {

Image difference(const Image& theirs, const Image& ours) {
  Image result = theirs;
  for (std::size_t i = 0; i < result.values().size(); ++i) result.values()[i] -= ours.values()[i];
  return result;
}

Packing pack_as_fine_as_fits(const std::vector<PackedImage>& images, std::size_t max_bytes,
                             std::map<std::string, std::string>& scripts) {
  if (images.empty()) return {0, kFinest};
  int fits = kCoarsest, too_fine = kFinest + 1;  // the bounds of a bisection
  std::size_t used = 0;
  for (int precision = kFinest; used == 0 || too_fine - fits > 1;) {
    std::map<std::string, std::string> made;
    std::size_t size = 0;
    for (const PackedImage& one : images)
      size += (made[one.name] = packed_image(one.image, precision, one.from_ours, 1)).size();
    if (size > max_bytes && precision > kCoarsest) {
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

namespace {

/// The scripts of all float pictures of a cell, by engine.
std::map<std::string, std::string> make_scripts(CellPictures& pictures, const CheckedCell& cell,
                                                const EnginePicture& our_image,
                                                std::size_t bytes_of_512) {
  std::map<std::string, std::string> scripts;
  const std::optional<Image>& ours = pictures.of(our_image.exr);
  if (!ours) return scripts;
  std::vector<PackedImage> others;
  // In a difference, values of ours that are not finite would hide theirs.
  const bool from_ours = is_finite(*ours);
  for (const EnginePicture& image : cell.images) {
    if (&image == &our_image || image.exr.empty()) continue;
    const std::optional<Image>& theirs = pictures.of(image.exr);
    if (!theirs || theirs->width() != ours->width() || theirs->height() != ours->height()) continue;
    others.push_back({image.engine, from_ours ? difference(*theirs, *ours) : *theirs, from_ours});
  }
  const std::size_t max_bytes = bytes_for(*ours, bytes_of_512);
  std::vector<PackedImage> first;
  first.push_back({our_image.engine, *ours, false});
  // A noisy picture takes all it can get: ours has half, the others the rest, and ours again what they leave.
  const Packing half = pack_as_fine_as_fits(first, max_bytes / 2, scripts);
  const std::size_t rest = max_bytes - std::min(max_bytes, half.bytes);
  const Packing theirs = pack_as_fine_as_fits(others, rest, scripts);
  if (half.precision < kFinest && theirs.bytes < rest)
    pack_as_fine_as_fits(first, max_bytes - theirs.bytes, scripts);
  return scripts;
}

}  // namespace

void publish_float_pictures(CellPictures& pictures, const GalleryOptions& options,
                            CheckedCell& cell, Publisher& publisher) {
  const EnginePicture* our_image = cell.find_image(cell.hub);
  if (!our_image || our_image->exr.empty()) return;
  const auto bytes = std::size_t(options.share_of_bytes * double(kFloatPictureBytes));
  // The key names all pictures, because they share the bytes.
  std::string all_hashes;
  for (const EnginePicture& image : cell.images)
    all_hashes += (all_hashes.empty() ? "" : " ") + image.exr_sha256;
  // Made together when the first is needed: an unchanged cell reads no picture.
  std::optional<std::map<std::string, std::string>> scripts;
  for (EnginePicture& image : cell.images) {
    if (image.exr.empty()) continue;
    const std::string file = image.engine + ".float.js";
    if (publisher.derive("cells/" + cell.id + "/" + file,
                         fmt::format("{} of {}, {}", kFloatFormat, bytes, all_hashes), [&] {
                           if (!scripts) scripts = make_scripts(pictures, cell, *our_image, bytes);
                           return (*scripts)[image.engine];
                         }))
      image.float_script = file;
  }
}

}  // namespace lobelia::gallery
