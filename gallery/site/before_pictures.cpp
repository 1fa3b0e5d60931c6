// The pictures of an earlier run, for the viewer's old against new.
#include <fmt/format.h>

#include <algorithm>

#include "base/pictures/image_values.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"
#include "gallery/site/derived_pictures.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostPngBytes = std::uint64_t{1} << 28;

/// An engine that is called so would have a file of that name.
std::string name_before(const CheckedCell& cell, const std::string& engine) {
  const std::string name = engine + ".before";
  return cell.find_image(name) ? "" : name;
}

bool is_other_picture(const CheckedCell& cell, const EnginePicture& before) {
  const EnginePicture* now = cell.find_image(before.engine);
  return now && before.png.shown() && now->png.shown() && before.png.width == now->png.width &&
         before.png.height == now->png.height && !before.exr_sha256.empty() &&
         before.exr_sha256 != now->exr_sha256 && !name_before(cell, before.engine).empty();
}

/// As our picture has it now.
std::map<std::string, std::string> make_scripts(const Image& ours, CellPictures& old_pictures,
                                                const CheckedCell& before, std::size_t of_512) {
  std::vector<PackedImage> images;
  const bool from_ours = is_finite(ours);
  for (const EnginePicture& image : before.images) {
    const std::optional<Image>& theirs = old_pictures.of(image.exr);
    if (!theirs || theirs->width() != ours.width() || theirs->height() != ours.height()) continue;
    images.push_back({image.engine, from_ours ? difference(*theirs, ours) : *theirs, from_ours});
  }
  std::map<std::string, std::string> scripts;
  pack_as_fine_as_fits(images, bytes_for(ours, of_512), scripts);
  return scripts;
}

void publish_floats(const fs::path& earlier, CellPictures& pictures, const GalleryOptions& options,
                    const CheckedCell& cell, CheckedCell& before, Publisher& publisher) {
  const EnginePicture* ours = cell.find_image(cell.hub);
  if (!ours || ours->float_script.empty()) return;
  const auto bytes = std::size_t(options.share_of_bytes * double(kFloatPictureBytes));
  std::string hashes = ours->exr_sha256;
  for (const EnginePicture& image : before.images) hashes += " " + image.exr_sha256;
  CellPictures old_pictures(earlier / "cells" / before.id);
  std::optional<std::map<std::string, std::string>> scripts;
  for (EnginePicture& image : before.images) {
    const std::string file = name_before(cell, image.engine) + ".float.js";
    if (publisher.derive("cells/" + cell.id + "/" + file,
                         fmt::format("{} before of {}, {}", kFloatFormat, bytes, hashes), [&] {
                           const std::optional<Image>& now = pictures.of(ours->exr);
                           if (!scripts)
                             scripts = now ? make_scripts(*now, old_pictures, before, bytes)
                                           : std::map<std::string, std::string>();
                           return (*scripts)[image.engine];
                         }))
      image.float_script = file;
  }
  std::erase_if(before.images,
                [](const EnginePicture& image) { return image.float_script.empty(); });
}

}  // namespace

void publish_before_pictures(const fs::path& earlier, CellPictures& pictures,
                             const GalleryOptions& options, const CheckedCell& cell,
                             CheckedCell& before, Publisher& publisher) {
  std::erase_if(before.images,
                [&](const EnginePicture& image) { return !is_other_picture(cell, image); });
  if (!options.metrics_only) publish_floats(earlier, pictures, options, cell, before, publisher);
  const std::string folder = "cells/" + cell.id + "/";
  for (EnginePicture& image : before.images) {
    const fs::path file = earlier / "cells" / before.id / image.png.file;
    image.png.file = name_before(cell, image.engine) + ".png";
    publish_small_picture(file, folder, options.metrics_only, image.png, publisher);
    if (image.png.is_published)
      publisher.derive(folder + image.png.file, "before 1 of " + hex(sha256_of_file(file)),
                       [&] { return read_file(file, kMostPngBytes); });
  }
}

}  // namespace lobelia::gallery
