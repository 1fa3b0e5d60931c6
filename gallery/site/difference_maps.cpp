#include <fmt/format.h>

#include <span>

#include "base/pictures/image_values.hpp"
#include "base/records/record.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/site/derived_pictures.hpp"

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

/// Runs of pixels that are not 0.
records::PixelRuns runs_of(std::span<const std::uint8_t> region, int width, int height) {
  records::PixelRuns result{width, height, {}};
  for (std::size_t i = 0; i < region.size();) {
    const auto row_end = (i / std::size_t(width) + 1) * std::size_t(width);
    std::size_t end = i;
    while (end < row_end && region[end] != 0) ++end;
    if (end > i) result.runs.insert(result.runs.end(), {int(i), int(end - i)});
    i = std::max(end, i + 1);
  }
  return result;
}

/// "" if there is nothing to outline, or too much: a noisy picture has no outline that could be seen.
std::string region_script(const RegionOf& region, const std::optional<Image>& a,
                          const std::optional<Image>& b) {
  constexpr std::size_t kMostRuns = 20'000;
  if (!a || !b || a->width() != b->width() || a->height() != b->height() || !is_finite(*a) ||
      !is_finite(*b))
    return "";
  const records::PixelRuns runs = runs_of(region(*a, *b), a->width(), a->height());
  return runs.runs.empty() || runs.runs.size() > 2 * kMostRuns
             ? ""
             : data_script("region", records::record_line(runs));
}

}  // namespace

void publish_difference_maps(CellPictures& pictures, const GalleryOptions& options,
                             CheckedCell& cell, Publisher& publisher) {
  const std::vector<MapKind>& kinds = options.maps;
  for (CheckedComparison& comparison : cell.comparisons) {
    const EnginePicture* a = cell.find_image(comparison.entry.a);
    const EnginePicture* b = cell.find_image(comparison.entry.b);
    const records::Viewing& seen = comparison.record.viewing;
    if (!a || !b || a->exr.empty() || b->exr.empty() || !comparison.problem.empty() || seen.display)
      continue;
    const MapViewing viewing{seen.exposure_stops, seen.pixels_per_degree};
    const std::string folder = "cells/" + cell.id + "/";
    const std::string pair = a->exr_sha256 + " and " + b->exr_sha256;
    if (const std::string file = cell.other_of(comparison) + ".region.js";
        options.region && publisher.derive(folder + file, "region 1 of " + pair, [&] {
          return region_script(options.region, pictures.of(a->exr), pictures.of(b->exr));
        }))
      comparison.region = file;
    if (kinds.empty()) continue;
    const auto bytes = std::size_t(options.share_of_bytes * double(kMapBytes)) /
                       (kinds.size() * cell.comparisons.size());
    for (const MapKind& kind : kinds) {
      const std::string file = fmt::format("{}.map.{}.js", cell.other_of(comparison), kind.id);
      const std::string key =
          fmt::format("{} of {}: {} of {}, {} stops, {} pixels per degree", kMapFormat, bytes,
                      kind.id, pair, viewing.exposure_stops, viewing.pixels_per_degree);
      if (publisher.derive(folder + file, key, [&] {
            return script_of(kind, viewing, pictures.of(a->exr), pictures.of(b->exr), bytes);
          }))
        comparison.maps.push_back({kind.id, kind.title, kind.meaning, file, kind.top});
    }
  }
}

}  // namespace lobelia::gallery
