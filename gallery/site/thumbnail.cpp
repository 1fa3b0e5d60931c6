#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "base/system/sha256.hpp"
#include "gallery/site/derived_pictures.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

constexpr int kThumbnailLonger = 160;         // pixels, of a thumbnail
constexpr float kBackground = 0.03f;          // of white: what no surface covers, where it is black
constexpr float kFrame = 0.35f;               // of white
constexpr float kLeastShare = 0.05f;          // of the peak: what belongs to the highlight
constexpr double kSmallHighlight = 0.2;       // of the picture's side: a smaller one is enlarged
constexpr double kInset = 0.42, kRoom = 1.6;  // of the thumbnail's side; of the highlight's

/// Pixels from (left, top) on.
struct Square {
  int left, top, side;
};

/// Around all pixels of the highlight. Empty if it is not small, or there is none.
std::optional<Square> small_highlight(const Image& image) {
  float peak = 0;
  for (const float value : image.values()) peak = std::max(peak, value);
  int left = image.width(), right = -1, top = image.height(), bottom = -1;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      if (!(std::ranges::max(image.pixel(x, y)) > kLeastShare * peak)) continue;
      left = std::min(left, x), right = std::max(right, x);
      top = std::min(top, y), bottom = std::max(bottom, y);
    }
  if (right < 0) return {};
  const int longer = std::max(right - left, bottom - top) + 1;
  const int side = std::max(5, int(std::ceil(longer * kRoom)));
  if (side > kSmallHighlight * std::min(image.width(), image.height())) return {};
  return Square{std::clamp((left + right + 1 - side) / 2, 0, image.width() - side),
                std::clamp((top + bottom + 1 - side) / 2, 0, image.height() - side), side};
}

void fill(Image& image, int x, int y, float value) {
  if (x < 0 || y < 0 || x >= image.width() || y >= image.height()) return;
  for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = value;
}

void draw_frame(Image& image, const Square& square) {
  for (int i = -1; i <= square.side; ++i)
    for (const auto& [x, y] : {std::pair(i, -1), {i, square.side}, {-1, i}, {square.side, i}})
      fill(image, square.left + x, square.top + y, kFrame);
}

/// Enlarges `of` in the corner that is farthest from it.
void draw_inset(Image& image, const Image& whole, const Square& of) {
  const int shorter = std::min(image.width(), image.height());
  const int side = int(shorter * kInset) / of.side * of.side, factor = side / of.side;
  if (factor < 2) return;
  const double scale = double(image.width()) / whole.width();
  const bool is_left = of.left + of.side / 2 < whole.width() / 2;
  const bool is_above = of.top + of.side / 2 < whole.height() / 2;
  const Square at{is_left ? image.width() - side - 3 : 3, is_above ? image.height() - side - 3 : 3,
                  side};
  draw_frame(image, {int(of.left * scale), int(of.top * scale), int(std::ceil(of.side * scale))});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      std::ranges::copy(whole.pixel(of.left + x / factor, of.top + y / factor),
                        image.pixel(at.left + x, at.top + y).begin());
  draw_frame(image, at);
}

DisplayImage thumbnail(const Image& whole, int width, int height, const PixelFlags& surface) {
  Image image = reduced(whole, width, height);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const auto pixel = image.pixel(int(i) % width, int(i) / width);
    if (!surface[i] && std::ranges::max(pixel) == 0) std::ranges::fill(pixel, kBackground);
  }
  if (const auto highlight = small_highlight(whole)) draw_inset(image, whole, *highlight);
  return to_display(image, 0);
}

}  // namespace

Thumbnail small_thumbnail(const Image& ours, const fs::path& run, const SurfaceOf& surface_of,
                          const CheckedCell& cell, int side) {
  const auto [width, height] = size_within(ours.width(), ours.height(), side);
  PixelFlags surface;
  bool knows_surface = true;
  if (surface_of && cell.has_scene) {
    try {
      surface = surface_of(run / "cells" / cell.id / "scene.xml", width, height);
    } catch (const Error& error) {
      // A scene of another version has no surface here.
      if (error.code() != ExitCode::kInput || error.is_fault()) throw;
      knows_surface = false;
    }
  }
  return {thumbnail(ours, width, height, surface), knows_surface};
}

void publish_thumbnail(const fs::path& run, const SurfaceOf& surface_of, CheckedCell& cell,
                       Publisher& publisher) {
  const EnginePicture* ours = cell.find_image(cell.hub);
  if (!ours || !ours->png.shown()) return;
  const fs::path directory = run / "cells" / cell.id;
  const bool has_scene = surface_of && cell.has_scene;
  const std::string key = fmt::format(
      "thumbnail 1 of {} {}", hex(sha256_of_file(directory / ours->png.file)),
      has_scene ? hex(sha256_of_file(directory / "scene.xml")) : std::string("no scene"));
  const std::string name = "cells/" + cell.id + "/thumbnail.png";
  bool is_final = true;
  if (publisher.derive(name, key, [&] {
        const auto shown = ShownPicture::read(directory / ours->png.file);
        if (!shown) return std::string();
        const Thumbnail made =
            small_thumbnail(shown->light(), run, surface_of, cell, kThumbnailLonger);
        is_final = made.knows_surface;
        return png_bytes(made.image);
      })) {
    if (!is_final) publisher.derive_again(name);
    const auto [width, height] = size_within(ours->png.width, ours->png.height, kThumbnailLonger);
    cell.thumbnail = {"thumbnail.png", width, height};
  }
}

}  // namespace lobelia::gallery
