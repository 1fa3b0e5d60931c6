#include <fmt/format.h>

#include "gallery/derived_pictures.hpp"

namespace lobelia::gallery {
namespace {

constexpr char kMapFormat[] = "map 1";  // a new number makes all scripts anew
constexpr int kPrecisions[] = {6, 2};   // bits: 1 % of a value, and enough for its colour
/// For all maps of a cell of 512 x 512 pixels; a larger one has more in proportion.
constexpr std::size_t kMapBytes = 96 << 10;
/// Smaller values count as 0: a thousandth of a difference that is noticed.
constexpr float kMinMapValue = 0x1p-10f;
constexpr int kMaxBlock = 16;

/// Grey, which packs like one channel. Each pixel is the largest of its block, so that no large difference is lost.
Image picture_of(const std::vector<float>& values, int width, int height, int block) {
  Image image((width + block - 1) / block, (height + block - 1) / block);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float value = values[std::size_t(y) * std::size_t(width) + std::size_t(x)];
      for (float& shown : image.pixel(x / block, y / block))
        if (value >= kMinMapValue && !(value <= shown)) shown = value;
    }
  return image;
}

std::string script_of(const MapKind& kind, const MapViewing& viewing, const std::optional<Image>& a,
                      const std::optional<Image>& b, std::size_t of_512) {
  if (!a || !b || a->width() != b->width() || a->height() != b->height()) return "";
  const auto values = kind.measure(*a, *b, viewing);
  const std::size_t max_bytes = bytes_for(*a, of_512);
  std::string script;
  // Noise is too large even with few bits, so its pixels are merged in blocks.
  for (int block = 1; block <= kMaxBlock; block *= 2)
    for (const int precision : kPrecisions) {
      script =
          packed_image(picture_of(values, a->width(), a->height(), block), precision, false, block);
      if (script.size() <= max_bytes) return script;
    }
  return script;
}

}  // namespace

void publish_difference_maps(CellPictures& pictures, const std::vector<MapKind>& kinds,
                             CheckedCell& cell, Publisher& publisher) {
  if (kinds.empty()) return;
  for (CheckedComparison& comparison : cell.comparisons) {
    const EnginePicture* a = cell.find_image(comparison.entry.a);
    const EnginePicture* b = cell.find_image(comparison.entry.b);
    const records::Viewing& seen = comparison.record.viewing;
    if (!a || !b || a->exr.empty() || b->exr.empty() || !comparison.problem.empty() || seen.display)
      continue;
    const MapViewing viewing{seen.exposure_stops, seen.pixels_per_degree};
    const std::size_t bytes = kMapBytes / (kinds.size() * cell.comparisons.size());
    for (const MapKind& kind : kinds) {
      const std::string file = fmt::format("{}.map.{}.js", comparison.entry.b, kind.id);
      const std::string key = fmt::format(
          "{} of {}: {} of {} and {}, {} stops, {} pixels per degree", kMapFormat, bytes, kind.id,
          a->exr_sha256, b->exr_sha256, viewing.exposure_stops, viewing.pixels_per_degree);
      if (publisher.derive("cells/" + cell.id + "/" + file, key, [&] {
            return script_of(kind, viewing, pictures.of(a->exr), pictures.of(b->exr), bytes);
          }))
        comparison.maps.push_back({kind.id, kind.title, kind.meaning, file});
    }
  }
}

}  // namespace lobelia::gallery
