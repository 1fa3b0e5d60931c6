#include "base/pictures/plain_picture.hpp"

#include <algorithm>

#include "base/pictures/orientation.hpp"
#include "base/pictures/png_module.hpp"

namespace lobelia {
namespace {

std::unique_ptr<PlainFile> open_plain(const PictureBytes& file) {
  auto plain = file.format == "openexr" ? open_plain_exr(file)
               : file.format == "png"   ? png_table().open_plain(file)
                                        : nullptr;
  if (!plain || !window_problem("", plain->window).empty()) return nullptr;
  return plain;
}

}  // namespace

bool may_be_plain(std::string_view format) { return format == "openexr" || format == "png"; }

std::optional<std::vector<std::string>> plain_layer_names(const PictureBytes& file) {
  const auto plain = open_plain(file);
  if (!plain) return std::nullopt;
  return picture_layer_names({&plain->part, 1});
}

std::optional<Picture> read_plain_picture(const PictureBytes& file, const std::string& layer_name) {
  const auto plain = open_plain(file);
  if (!plain) return std::nullopt;
  const std::span<const PicturePart> parts(&plain->part, 1);
  const PictureLayer layer = find_layer(file.path.string(), parts, layer_name);
  const int width = plain->window.width, height = plain->window.height;
  const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
  if (file.on_header)
    file.on_header({2 * pixels, pixels * plain->part.channels.size() * plain->value_bytes});

  PictureSource source = picture_source(file.format, parts, layer);
  source.value_type = plain->value_type;
  source.samples = samples_stated(plain->attributes, source.channels[0]);
  source.data = source.display = plain->window;
  source.as_stored = file.as_stored;
  const bool is_decoded = layer.is_colour && !file.as_stored;
  source.multiplied_by_alpha = is_decoded && plain->is_unassociated;
  const ColourMeaning meaning = is_decoded ? plain->meaning(file.path) : ColourMeaning();

  const bool in_bands = file.on_rows && plain->band_rows > 0;
  const int rows = in_bands ? rows_of_band(width, plain->band_rows) : height;
  for (int y = 0; y < height; y += rows) {
    Picture band{Image(width, std::min(rows, height - y)), {}, source};
    if (!plain->read(y, layer.where, band.image)) {
      if (y == 0) return std::nullopt;
      unreadable_picture(file.path, "its values cannot be decoded");
    }
    decode_colours(file.path, meaning, band);
    if (source.multiplied_by_alpha) {
      Image alpha(width, band.image.height());
      if (!plain->read(y, {plain->part.channels.size() - 1}, alpha)) return std::nullopt;
      for (std::size_t i = 0; i < alpha.values().size(); ++i)
        band.image.values()[i] *= alpha.values()[i];
    }
    if (!in_bands) {
      turn_upright(band, stated_orientation(file.bytes, file.format));
      return band;
    }
    file.on_rows(band, y);
  }
  return Picture{{}, {}, source};
}

}  // namespace lobelia
