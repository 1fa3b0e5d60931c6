#include <fmt/format.h>

#include <array>

#include "gallery/site/derived_pictures.hpp"

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "base/pictures/png_module.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

constexpr int kSmallSide = 160;  // pixels, of the longer side
/// A picture file up to this size is its own preview.
constexpr std::uintmax_t kLightBytes = 48 << 10;
constexpr std::uint64_t kMostShownBytes = std::uint64_t{1} << 28;  // of a PNG file
/// Pixels a side of a PNG that is read in this process: a process for each (decision 8) would be most of the work.
constexpr int kMostPlainSide = 4096;

}  // namespace

PictureSize size_within(int width, int height, int side) {
  const double factor = std::min(1.0, double(side) / std::max(width, height));
  return {std::max(1, int(width * factor + 0.5)), std::max(1, int(height * factor + 0.5))};
}

Image reduced(const Image& image, int width, int height) {
  const auto covered = [](int i, int count, int size) {
    const auto from = int(std::int64_t{i} * size / count);
    return std::pair(from, std::max(from + 1, int(std::int64_t{i + 1} * size / count)));
  };
  Image result(width, height);
  for (int y = 0; y < height; ++y) {
    const auto [y0, y1] = covered(y, height, image.height());
    for (int x = 0; x < width; ++x) {
      const auto [x0, x1] = covered(x, width, image.width());
      double sum[3] = {};
      for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u)
          for (int c = 0; c < 3; ++c) sum[c] += image.pixel(u, v)[c];
      for (int c = 0; c < 3; ++c)
        result.pixel(x, y)[c] = static_cast<float>(sum[c] / (double(x1 - x0) * (y1 - y0)));
    }
  }
  return result;
}

namespace {

/// Nothing where the file is no picture: it stays so. Throws where the system failed: what is made without the picture would
/// stay as well.
std::optional<Image> decoded(const fs::path& file) {
  try {
    return read_image(file);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput || error.is_fault()) throw;
    return {};
  }
}

/// Empty where the file is no picture.
std::string small_png(const fs::path& picture, int width, int height) {
  const std::optional<Image> image = decoded(picture);
  return image ? png_bytes(to_display(reduced(*image, width, height), 0)) : "";
}

std::string small_name(const std::string& file) {
  return fs::path(file).stem().string() + ".small.png";
}

/// The light of a display's pixels.
Image light_of(const DisplayImage& shown) {
  static const std::array<float, 256> kLight = [] {
    std::array<float, 256> light{};
    for (int i = 0; i < 256; ++i) light[i] = srgb_decoded(float(i) / 255);
    return light;
  }();
  Image image(shown.width, shown.height);
  for (std::size_t i = 0; i < shown.rgb.size(); ++i) image.values()[i] = kLight[shown.rgb[i]];
  return image;
}

}  // namespace

std::optional<ShownPicture> ShownPicture::read(const fs::path& file) {
  std::optional<DisplayImage> plain =
      png_table().read_codes(read_file(file, kMostShownBytes), kMostPlainSide);
  std::optional<Image> light = plain ? light_of(*plain) : decoded(file);
  if (!light) return {};
  return ShownPicture(std::move(plain), std::move(*light));
}

DisplayImage ShownPicture::within(int side) const {
  const bool is_small = std::max(light_.width(), light_.height()) <= side;
  if (is_small) return plain_ ? *plain_ : to_display(light_, 0);
  const auto [width, height] = size_within(light_.width(), light_.height(), side);
  return to_display(reduced(light_, width, height), 0);
}

Picture publish_shown(const std::string& cell, const std::string& file, const DisplayImage& shown,
                      bool only_small, Publisher& publisher) {
  const std::string folder = "cells/" + cell + "/";
  const std::string_view bytes(reinterpret_cast<const char*>(shown.rgb.data()), shown.rgb.size());
  const std::string key =
      fmt::format("{} x {} of {}", shown.width, shown.height, hex(sha256(bytes)));
  Picture picture{file, shown.width, shown.height, ""};
  const bool is_large = std::max(shown.width, shown.height) > kSmallSide;
  if (is_large) {
    const auto [width, height] = size_within(shown.width, shown.height, kSmallSide);
    const std::string name = small_name(file);
    publisher.derive(folder + name, "small shown 1 " + key, [&] {
      return png_bytes(to_display(reduced(light_of(shown), width, height), 0));
    });
    picture.small = {name, width, height};
    picture.is_published = !only_small;
  }
  if (picture.is_published)
    publisher.derive(folder + file, "shown 1 " + key, [&] { return png_bytes(shown); });
  return picture;
}

void publish_small_picture(const fs::path& file, const std::string& folder, bool all,
                           Picture& picture, Publisher& publisher) {
  if (!picture.shown() || std::max(picture.width, picture.height) <= kSmallSide) return;
  std::error_code ignored;
  if (!all && fs::file_size(file, ignored) <= kLightBytes) return;
  const auto [width, height] = size_within(picture.width, picture.height, kSmallSide);
  const std::string name = small_name(picture.file);
  if (publisher.derive(folder + name, "small picture 1 of " + hex(sha256_of_file(file)),
                       [&] { return small_png(file, width, height); }))
    picture.small = {name, width, height};
  if (all && !picture.small.file.empty()) picture.is_published = false;
}

void publish_small_pictures(const fs::path& run, CheckedCell& cell, bool all,
                            Publisher& publisher) {
  const std::string folder = "cells/" + cell.id + "/";
  const auto publish = [&](Picture& picture) {
    publish_small_picture(run / folder / picture.file, folder, all, picture, publisher);
  };
  for (EnginePicture& image : cell.images) publish(image.png);
  for (CheckedComparison& comparison : cell.comparisons) publish(comparison.png);
}

}  // namespace lobelia::gallery
