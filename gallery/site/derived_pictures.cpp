#include "gallery/site/derived_pictures.hpp"

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "gallery/packed/half_picture.hpp"
#include "gallery/pages/page.hpp"

namespace lobelia::gallery {

const std::optional<Image>& CellPictures::of(const std::string& file) {
  const auto [place, is_new] = pictures_.try_emplace(file);
  if (!is_new) return place->second;
  place->second = read_image(directory_ / file);
  return place->second;
}

std::size_t bytes_for(const Image& image, std::size_t of_512) {
  constexpr std::size_t kReferencePixels = 512 * 512;
  return of_512 * std::max(image.pixel_count(), kReferencePixels) / kReferencePixels;
}

std::string packed_image(const Image& image, int precision, bool from_ours, int block) {
  records::PackedPicture picture = half_picture(image, precision);
  picture.from_ours = from_ours;
  picture.block = block;
  return data_script("float picture", records::record_line(picture));
}

}  // namespace lobelia::gallery
